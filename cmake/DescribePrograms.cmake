# meshrepair_describe(NAME): the manual page of a program and its completions, which the program prints itself, so that
# they say what --help says. They are made below share of the build folder, and installed from there. A program that is
# built for another system is asked through CMAKE_CROSSCOMPILING_EMULATOR, and without one not at all; Windows has neither kind of file.
#
# Run as a script, -P with PROGRAM, EMULATOR, NAME and FOLDER, it makes those of one program.
if(CMAKE_SCRIPT_MODE_FILE)
  cmake_minimum_required(VERSION 3.25)
endif()
set(man_page share/man/man1/@NAME@.1)
set(completion_bash share/bash-completion/completions/@NAME@)
set(completion_zsh share/zsh/site-functions/_@NAME@)
set(completion_fish share/fish/vendor_completions.d/@NAME@.fish)
set(kinds man:man_page bash:completion_bash zsh:completion_zsh fish:completion_fish)

if(CMAKE_SCRIPT_MODE_FILE)
  foreach(kind ${kinds})
    string(REPLACE ":" ";" pair ${kind})
    list(GET pair 0 word)
    list(GET pair 1 path)
    string(CONFIGURE ${${path}} file @ONLY)
    cmake_path(GET file PARENT_PATH folder)
    file(MAKE_DIRECTORY ${FOLDER}/${folder})
    execute_process(COMMAND ${EMULATOR} ${PROGRAM} --describe ${word} OUTPUT_FILE ${FOLDER}/${file} COMMAND_ERROR_IS_FATAL ANY)
  endforeach()
  return()
endif()

set(describe_script ${CMAKE_CURRENT_LIST_FILE})

function(meshrepair_describe NAME)
  if(EMSCRIPTEN OR WIN32 OR (CMAKE_CROSSCOMPILING AND NOT CMAKE_CROSSCOMPILING_EMULATOR))
    return()
  endif()
  set(files "")
  foreach(path man_page completion_bash completion_zsh completion_fish)
    string(CONFIGURE ${${path}} file @ONLY)
    list(APPEND files ${PROJECT_BINARY_DIR}/${file})
    cmake_path(GET file PARENT_PATH folder)
    cmake_path(RELATIVE_PATH folder BASE_DIRECTORY share)
    install(FILES ${PROJECT_BINARY_DIR}/${file} DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/${folder})
  endforeach()
  add_custom_command(
    OUTPUT ${files}
    COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:app_${NAME}> -D "EMULATOR=${CMAKE_CROSSCOMPILING_EMULATOR}" -D NAME=${NAME}
            -D FOLDER=${PROJECT_BINARY_DIR} -P ${describe_script}
    DEPENDS app_${NAME} ${describe_script}
    VERBATIM
    COMMENT "Describing ${NAME}")
  add_custom_target(describe_${NAME} ALL DEPENDS ${files})
endfunction()
