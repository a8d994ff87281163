# How CMake builds for WebAssembly with Debian's emscripten: for the libraries of others that scripts/make_dependencies.sh makes,
# and for the preset wasm. All that is linked together has the same kind of exceptions, those of WebAssembly itself.
if(NOT DEFINED ENV{NODE_PATH})
  set(ENV{NODE_PATH} /usr/share/nodejs) # where Debian's emscripten finds acorn, whichever node runs it
endif()
# What emscripten 3.1.6 builds takes a node that has fetch() for a browser; programs that CMake tries would fail.
set(ENV{NODE_OPTIONS} --no-experimental-fetch)
set(MESHREPAIR_WASM_DEPENDENCIES ${CMAKE_CURRENT_LIST_DIR}/../build/wasm-dependencies)

# Vectors of 128 bits are in all browsers since 2023.
set(meshrepair_wasm_flags "-fwasm-exceptions -sSUPPORT_LONGJMP=wasm -msimd128")
set(CMAKE_C_FLAGS_INIT "${meshrepair_wasm_flags}")
# With what the compiler lacks.
set(CMAKE_CXX_FLAGS_INIT "${meshrepair_wasm_flags} -isystem ${CMAKE_CURRENT_LIST_DIR}/wasm_std")

include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)

# After what emscripten says, which knows nothing of these.
list(APPEND CMAKE_FIND_ROOT_PATH ${MESHREPAIR_WASM_DEPENDENCIES})
list(APPEND CMAKE_PREFIX_PATH ${MESHREPAIR_WASM_DEPENDENCIES})
set(ENV{PKG_CONFIG_LIBDIR} ${MESHREPAIR_WASM_DEPENDENCIES}/lib/pkgconfig)
