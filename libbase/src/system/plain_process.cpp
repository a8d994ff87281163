// SPDX-License-Identifier: MIT
// For macOS, BSD and others: what POSIX has, and what nearly all of them have besides.
#include <algorithm>
#include <cstdlib>
#include <dlfcn.h>
#include <fcntl.h>
#include <string>
#include <string_view>
#include <unistd.h>
#ifdef __APPLE__
#include <mach/mach.h>
#endif

#include <base/internal/processes.h>
#include <base/internal/system.h>

namespace meshrepair::internal {
namespace {

namespace fs = std::filesystem;

bool keep_to_this_process(int descriptor) { return ::fcntl(descriptor, F_SETFD, FD_CLOEXEC) == 0; }

// Where a shell finds it. Empty: nowhere.
fs::path found_in_path(const fs::path& name) {
  const char* const given = std::getenv("PATH");  // NOLINT(concurrency-mt-unsafe): never changed
  std::string_view rest = given == nullptr ? "" : given;
  while (!rest.empty()) {
    const std::string_view folder = rest.substr(0, rest.find(':'));
    rest.remove_prefix(std::min(folder.size() + 1, rest.size()));
    fs::path file = fs::path(folder) / name;
    if (::access(file.c_str(), X_OK) == 0) return file;
  }
  return {};
}

// POSIX does not tell which one wakes poll() up.
bool is_any_due(const sigset_t& blocked) {
  constexpr int kSignals = 31;  // that all systems have
  sigset_t pending;
  ::sigpending(&pending);
  for (int number = 1; number <= kSignals; ++number) {
    if (sigismember(&pending, number) == 1 && sigismember(&blocked, number) == 0) return true;
  }
  return false;
}

#ifndef __APPLE__
void lower_limit(int which, std::uint64_t bytes) {
  rlimit limit = {};
  if (::getrlimit(which, &limit) != 0) return;
  limit.rlim_cur = std::min(limit.rlim_cur, static_cast<rlim_t>(bytes));
  ::setrlimit(which, &limit);
}
#endif

}  // namespace

// The file that the code of this function was loaded from. Some systems tell its full path, others
// the word by which the program was started.
fs::path program_file() {
  Dl_info found = {};
  if (::dladdr(reinterpret_cast<const void*>(&program_file), &found) == 0) return {};
  const fs::path name = found.dli_fname;
  const fs::path file = name.has_parent_path() ? name : found_in_path(name);
  return ::access(file.c_str(), R_OK) == 0 ? file : fs::path();
}

int nameless_file() noexcept {
  std::string name = "/tmp/meshrepair-XXXXXX";
  const int file = ::mkstemp(name.data());
  if (file >= 0) ::unlink(name.c_str());
  if (file >= 0) keep_to_this_process(file);
  return file;
}

bool open_pipe(std::array<int, 2>& ends) noexcept {
  return ::pipe(ends.data()) == 0 && keep_to_this_process(ends[0]) && keep_to_this_process(ends[1]);
}

fs::path path_of_folder(int /*descriptor*/, const fs::path& name) { return name; }

void end_with_parent() noexcept {}

// A signal that comes just before poll() is seen when its short time is over.
int poll_with_signals(std::span<pollfd> files, int milliseconds, const sigset_t& blocked) noexcept {
  constexpr int kMost = 20;
  int time = milliseconds < 0 ? kMost : std::min(milliseconds, kMost);
  if (is_any_due(blocked)) time = 0;
  sigset_t before;
  ::pthread_sigmask(SIG_SETMASK, &blocked, &before);
  const int count = ::poll(files.data(), static_cast<nfds_t>(files.size()), time);
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return count;
}

std::uint64_t peak_memory_of(const rusage& usage) noexcept {
#ifdef __APPLE__
  constexpr std::uint64_t kUnit = 1;
#else
  constexpr std::uint64_t kUnit = 1024;
#endif
  return static_cast<std::uint64_t>(usage.ru_maxrss) * kUnit;
}

// POSIX does not tell.
ProcessMemory process_memory() noexcept {
#ifdef __APPLE__
  mach_task_basic_info info = {};
  mach_msg_type_number_t count = MACH_TASK_BASIC_INFO_COUNT;
  const kern_return_t failed = ::task_info(mach_task_self(), MACH_TASK_BASIC_INFO,
                                           reinterpret_cast<task_info_t>(&info), &count);
  if (failed == KERN_SUCCESS) return {info.resident_size, info.resident_size, 0};
#endif
  return {};
}

// All of the machine: nobody tells what of it is free.
std::optional<std::uint64_t> free_memory() {
  const long pages = ::sysconf(_SC_PHYS_PAGES), bytes = ::sysconf(_SC_PAGESIZE);
  if (pages <= 0 || bytes <= 0) return std::nullopt;
  return static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(bytes);
}

// Some systems know the one limit, some the other. That of macOS counts addresses, of which its own
// libraries take gigabytes: there the program looks at process_memory() alone.
std::uint64_t limit_process_memory(std::uint64_t bytes, [[maybe_unused]] std::size_t threads) {
  constexpr std::uint64_t kNeeded = std::uint64_t{16} << 20;
  if (bytes < kNeeded) return kNeeded;
#ifndef __APPLE__
  constexpr std::uint64_t kStackBytes = std::uint64_t{8} << 20;  // of a thread, in use or not
  constexpr std::uint64_t kCode = std::uint64_t{256} << 20;      // of the program and libraries
  const std::uint64_t data = bytes + threads * kStackBytes;
  lower_limit(RLIMIT_DATA, data);
#ifdef RLIMIT_AS
  lower_limit(RLIMIT_AS, data + kCode);
#endif
#endif
  return 0;
}

}  // namespace meshrepair::internal
