# How CMake builds for 64-bit ARM Linux with Debian's compiler, and runs with qemu what it built: for the preset arm64. The libraries of
# that machine, also of C and C++, are in the folder that scripts/make_arm64_sysroot.sh fills.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
cmake_path(ABSOLUTE_PATH CMAKE_CURRENT_LIST_DIR NORMALIZE OUTPUT_VARIABLE meshrepair_cmake_folder)
cmake_path(GET meshrepair_cmake_folder PARENT_PATH meshrepair_root)
set(CMAKE_SYSROOT ${meshrepair_root}/build/arm64-sysroot)
if(NOT EXISTS ${CMAKE_SYSROOT}/usr/include)
  message(FATAL_ERROR "There is no ${CMAKE_SYSROOT}; run scripts/setup.sh arm64")
endif()

set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
# An address space of 16 GiB: qemu 7.2 keeps a note in memory of each page that is mapped, and --max-memory maps all it can get, without
# memory, for a file (apps/spill).
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64;-L;${CMAKE_SYSROOT};-R;16G)

# Programs are those of this machine, all else that of the other.
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(ENV{PKG_CONFIG_SYSROOT_DIR} ${CMAKE_SYSROOT})
set(ENV{PKG_CONFIG_LIBDIR} ${CMAKE_SYSROOT}/usr/lib/aarch64-linux-gnu/pkgconfig:${CMAKE_SYSROOT}/usr/share/pkgconfig)
