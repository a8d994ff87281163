# cli_test(NAME name APP program ARGS arg... [EXIT code] [STDIN text | STDIN_FILE file]
#          [COPY name=file...] [STDOUT regex...] [STDERR regex...] [EXISTS file...] [MISSING file...]
#          [UNCHANGED name...] [JSON file:key=value...] [SIGNAL name] [SIGNAL_AFTER regex]
#          [FILE_SIZE_LIMIT bytes] [CLOSED_STDOUT] [UNREAD_STDOUT] [RUN_IN_TERMINAL] [FIXTURES name...] [LABELS label...])
#
# One behaviour of a program as one test, "name": the program runs in a folder of its own, empty but for the files
# that COPY puts there; those that UNCHANGED names must be as they were in the end. EXIT is 0 unless told. Regexes are Python's and are searched for anywhere in the
# stream ("^$" is: nothing was printed); a lone "[" would glue list items together in CMake, so write ".". JSON compares one value of a written file, "-" being stdout: keys
# are joined by dots, the value is JSON ("report.json:exit_code=3", "report.json:error=null").
# SIGNAL sends a signal (INT, TERM) once the program has printed something to stdout, or,
# with SIGNAL_AFTER, once what it has printed to stderr matches.
# Each report that the program writes is held against docs/report.schema.json.
# FILE_SIZE_LIMIT is that of "ulimit -f". No test may leave a temporary file (*.tmp) behind.
# CLOSED_STDOUT gives it a stdout whose other end is closed, UNREAD_STDOUT one that is open but that nobody reads; RUN_IN_TERMINAL gives it a terminal as stderr.
function(cli_test)
  cmake_parse_arguments(
    ARG "RUN_IN_TERMINAL;CLOSED_STDOUT;UNREAD_STDOUT" "NAME;APP;EXIT;STDIN;STDIN_FILE;SIGNAL;SIGNAL_AFTER;FILE_SIZE_LIMIT"
    "ARGS;COPY;STDOUT;STDERR;EXISTS;MISSING;UNCHANGED;JSON;FIXTURES;LABELS" ${ARGN})
  if(ARG_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "cli_test ${ARG_NAME}: unknown ${ARG_UNPARSED_ARGUMENTS}")
  endif()
  set(checks "")
  foreach(option EXIT STDIN STDIN_FILE SIGNAL SIGNAL_AFTER FILE_SIZE_LIMIT)
    if(DEFINED ARG_${option})
      string(TOLOWER ${option} flag)
      string(REPLACE "_" "-" flag ${flag})
      list(APPEND checks "--${flag}=${ARG_${option}}")
    endif()
  endforeach()
  foreach(option COPY STDOUT STDERR EXISTS MISSING UNCHANGED JSON)
    string(TOLOWER ${option} flag)
    foreach(value IN LISTS ARG_${option})
      list(APPEND checks "--${flag}=${value}")
    endforeach()
  endforeach()
  if(ARG_RUN_IN_TERMINAL)
    list(APPEND checks --run-in-terminal)
  endif()
  if(ARG_CLOSED_STDOUT)
    list(APPEND checks --closed-stdout)
  endif()
  if(ARG_UNREAD_STDOUT)
    list(APPEND checks --unread-stdout)
  endif()
  add_test(NAME ${ARG_NAME} COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/tests/apps/run_cli_test.py
                                    ${checks} -- ${CMAKE_CROSSCOMPILING_EMULATOR} $<TARGET_FILE:${ARG_APP}> ${ARG_ARGS})
  set_tests_properties(${ARG_NAME} PROPERTIES TIMEOUT 600 SKIP_RETURN_CODE 77
                                                LABELS "cli;${ARG_LABELS}"
                                                FIXTURES_REQUIRED "${ARG_FIXTURES}")
endfunction()
