// SPDX-License-Identifier: MIT
// What starting other processes needs beyond POSIX. Windows and WebAssembly start none. Linux has a
// call of its own for each of these; what other systems do in its place is in
// libbase/src/system/plain_process.cpp.
#pragma once

#include <array>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <poll.h>
#include <span>
#include <sys/resource.h>

namespace meshrepair::internal {

// The descriptors that these give are not passed on to programs that are started. Errors are in
// errno.

// An empty file without a name, in memory where the system has such files. -1: an error.
[[nodiscard]] int nameless_file() noexcept;
// False: an error.
[[nodiscard]] bool open_pipe(std::array<int, 2>& ends) noexcept;
// A path that leads into a folder that is open. Linux goes by the descriptor, so that nobody can
// put another folder in its place; other systems go by the name.
[[nodiscard]] std::filesystem::path path_of_folder(int descriptor,
                                                   const std::filesystem::path& name);

// Called in a process after fork(): it is killed when its parent ends. Without Linux nothing
// happens then: it ends when its work is done.
void end_with_parent() noexcept;
// poll(), while these signals are blocked and no others are. Without Linux it may return early,
// with nothing ready.
[[nodiscard]] int poll_with_signals(std::span<pollfd> files, int milliseconds,
                                    const sigset_t& blocked) noexcept;
// In bytes.
[[nodiscard]] std::uint64_t peak_memory_of(const rusage& usage) noexcept;

}  // namespace meshrepair::internal
