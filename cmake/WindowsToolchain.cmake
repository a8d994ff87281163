# How CMake builds for Windows on x86-64 with Debian's mingw-w64, the one whose threads are those of POSIX: for the libraries of others
# that scripts/make_dependencies.sh makes, and for the preset windows. All is linked statically, so that a program is one file.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)
# The same in, the same out: without the time.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static -s -Wl,--no-insert-timestamp")
set(CMAKE_CROSSCOMPILING_EMULATOR ${CMAKE_CURRENT_LIST_DIR}/../scripts/run_wine.sh)

set(MESHREPAIR_WINDOWS_DEPENDENCIES ${CMAKE_CURRENT_LIST_DIR}/../build/windows-dependencies)
set(CMAKE_FIND_ROOT_PATH ${MESHREPAIR_WINDOWS_DEPENDENCIES} /usr/x86_64-w64-mingw32)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(ENV{PKG_CONFIG_LIBDIR} ${MESHREPAIR_WINDOWS_DEPENDENCIES}/lib/pkgconfig)
