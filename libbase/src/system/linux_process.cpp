// SPDX-License-Identifier: MIT
#include <fcntl.h>
#include <string>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <base/internal/processes.h>
#include <base/internal/system.h>

namespace meshrepair::internal {

std::filesystem::path program_file() { return "/proc/self/exe"; }

int nameless_file() noexcept { return ::memfd_create("meshrepair", MFD_CLOEXEC); }

bool open_pipe(std::array<int, 2>& ends) noexcept { return ::pipe2(ends.data(), O_CLOEXEC) == 0; }

std::filesystem::path path_of_folder(int descriptor, const std::filesystem::path& /*name*/) {
  return "/proc/self/fd/" + std::to_string(descriptor);
}

void end_with_parent() noexcept { ::prctl(PR_SET_PDEATHSIG, SIGKILL); }

int poll_with_signals(std::span<pollfd> files, int milliseconds, const sigset_t& blocked) noexcept {
  const timespec time = {milliseconds / 1000, milliseconds % 1000 * 1000000L};
  return ::ppoll(files.data(), files.size(), milliseconds < 0 ? nullptr : &time, &blocked);
}

// The system counts in kilobytes.
std::uint64_t peak_memory_of(const rusage& usage) noexcept {
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

}  // namespace meshrepair::internal
