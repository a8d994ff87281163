# What every target of the project has in common.

# Headers of others that are parsed once, not for each source; the project's own are not among them, so a change of one of these
# compiles again what includes it and nothing else. Sources include what they use all the same: OFF shows whether they do.
option(MESHREPAIR_PRECOMPILE "Precompile headers of the standard library, Eigen, GoogleTest and others" ${PROJECT_IS_TOP_LEVEL})

# meshrepair_precompile(tests HEADERS <vector> ... LINK GTest::gtest): the targets of this folder and those below it share these.
function(meshrepair_precompile name)
  cmake_parse_arguments(ARG "" "" "HEADERS;LINK" ${ARGN})
  if(NOT MESHREPAIR_PRECOMPILE)
    return()
  endif()
  set(target meshrepair_precompiled_${name})
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${target}.cpp CONTENT "")
  add_library(${target} OBJECT ${CMAKE_CURRENT_BINARY_DIR}/${target}.cpp)
  target_link_libraries(${target} PRIVATE ${ARG_LINK})
  target_precompile_headers(${target} PRIVATE ${ARG_HEADERS})
  set(MESHREPAIR_PRECOMPILED "")
  meshrepair_configure(${target})
  set(MESHREPAIR_PRECOMPILED ${target} PARENT_SCOPE)
endfunction()

# Those who pack the project have other compilers, which may warn of more.
option(MESHREPAIR_WARNINGS_AS_ERRORS "Fail where the compiler warns" ${PROJECT_IS_TOP_LEVEL})

# Compile settings shared by libraries, programs and tests. Contraction of a*b+c into one rounding is
# off: the error bounds of the predicates and the "same input, same bytes" promise assume none.
function(meshrepair_configure target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_compile_options(${target} PRIVATE -ffp-contract=off)
  if(PROJECT_IS_TOP_LEVEL)
    target_compile_options(${target} PRIVATE -Wall -Wextra -Wconversion -Wshadow $<$<BOOL:${MESHREPAIR_WARNINGS_AS_ERRORS}>:-Werror>)
    # GCC 12 sees strings overflow that are added, unless its own headers are parsed with each source.
    if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
      target_compile_options(${target} PRIVATE -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow)
    endif()
  endif()
  if(MESHREPAIR_PRECOMPILED)
    target_precompile_headers(${target} REUSE_FROM ${MESHREPAIR_PRECOMPILED})
  endif()
endfunction()

# meshrepair_library(NAME bsp KNOWS "..." SOURCES ... HEADERS ... LINK ...): a static library with its
# own include root, installed and exported as meshrepair::NAME. KNOWS says what it is about, for the
# picture of the architecture.
function(meshrepair_library)
  cmake_parse_arguments(ARG "" "NAME;KNOWS" "SOURCES;HEADERS;LINK;LINK_PRIVATE" ${ARGN})
  set(target meshrepair_${ARG_NAME})
  add_library(${target} STATIC ${ARG_SOURCES})
  add_library(meshrepair::${ARG_NAME} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${ARG_NAME} VERIFY_INTERFACE_HEADER_SETS ON)
  target_sources(${target} PUBLIC FILE_SET HEADERS BASE_DIRS include FILES ${ARG_HEADERS})
  target_include_directories(${target} PRIVATE src)
  target_link_libraries(${target} PUBLIC ${ARG_LINK} PRIVATE ${ARG_LINK_PRIVATE})
  meshrepair_configure(${target})
  # Names such as <base/error.h> are not for all projects of a machine to see.
  install(TARGETS ${target} EXPORT meshrepair-targets FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/meshrepair)
endfunction()
