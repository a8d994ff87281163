// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <atomic>
#include <fcntl.h>
#include <io.h>
#include <utility>
#include <windows.h>
// Behind the one that it needs.
#include <psapi.h>

#include <base/internal/system.h>

namespace meshrepair::internal {
namespace {

std::uint64_t ticks_of(const FILETIME& time) {
  return (std::uint64_t{time.dwHighDateTime} << 32) | time.dwLowDateTime;
}

PROCESS_MEMORY_COUNTERS_EX counters() noexcept {
  PROCESS_MEMORY_COUNTERS_EX all = {};
  ::K32GetProcessMemoryInfo(::GetCurrentProcess(), reinterpret_cast<PROCESS_MEMORY_COUNTERS*>(&all),
                            sizeof all);
  return all;
}

std::atomic<void (*)(int)> handler = nullptr;

// In a thread of its own.
BOOL WINAPI handle_console(DWORD event) {
  const auto handle = handler.load();
  if (handle == nullptr) return FALSE;
  handle(event == CTRL_C_EVENT ? kInterrupt : kTerminate);
  // A program whose window is closed has some seconds from here on.
  constexpr DWORD kMilliseconds = 4000;
  if (event != CTRL_C_EVENT && event != CTRL_BREAK_EVENT) ::Sleep(kMilliseconds);
  return TRUE;
}

}  // namespace

double cpu_seconds() noexcept {
  constexpr double kTick = 1e-7;
  FILETIME start, end, kernel = {}, user = {};
  ::GetProcessTimes(::GetCurrentProcess(), &start, &end, &kernel, &user);
  return kTick * static_cast<double>(ticks_of(kernel) + ticks_of(user));
}

std::size_t peak_memory() noexcept { return counters().PeakWorkingSetSize; }

ProcessMemory process_memory() noexcept {
  const PROCESS_MEMORY_COUNTERS_EX now = counters();
  return {now.WorkingSetSize, std::min(now.PrivateUsage, now.WorkingSetSize), now.PrivateUsage};
}

std::optional<std::uint64_t> free_memory() {
  MEMORYSTATUSEX status = {};
  status.dwLength = sizeof status;
  if (::GlobalMemoryStatusEx(&status) == 0) return std::nullopt;
  return status.ullAvailPhys;
}

// What a job's processes commit. The stacks of threads are committed as they grow.
std::uint64_t limit_process_memory(std::uint64_t bytes, std::size_t /*threads*/) {
  constexpr std::uint64_t kLeast = std::uint64_t{8} << 20;  // beyond what the program has taken
  const std::uint64_t used = process_memory().reserved;
  if (bytes < used + kLeast) return used + kLeast;
  const HANDLE job = ::CreateJobObjectW(nullptr, nullptr);
  if (job == nullptr) return 0;
  JOBOBJECT_EXTENDED_LIMIT_INFORMATION limit = {};
  limit.BasicLimitInformation.LimitFlags = JOB_OBJECT_LIMIT_PROCESS_MEMORY;
  limit.ProcessMemoryLimit = bytes;
  ::SetInformationJobObject(job, JobObjectExtendedLimitInformation, &limit, sizeof limit);
  ::AssignProcessToJobObject(job, ::GetCurrentProcess());
  return 0;
}

void end_process_now(int code) noexcept {
  ::TerminateProcess(::GetCurrentProcess(), static_cast<UINT>(code));
  std::abort();
}

std::filesystem::path program_file() {
  std::array<wchar_t, 32768> name = {};
  const DWORD size = ::GetModuleFileNameW(nullptr, name.data(), static_cast<DWORD>(name.size()));
  return std::wstring(name.data(), size);
}

bool is_open(int descriptor) noexcept { return ::_get_osfhandle(descriptor) != -1; }

void handle_request_to_end(int /*number*/, void (*handle)(int number)) noexcept {
  handler = handle;
  ::SetConsoleCtrlHandler(handle_console, TRUE);
}

int request_to_end_without_handler() noexcept { return 0; }

// They are opened before the program begins, as text, which would end each line with CR LF.
void prepare_standard_streams() noexcept {
  for (const int stream : {kStandardInput, kStandardOutput, kStandardError}) {
    ::_setmode(stream, _O_BINARY);
  }
}

std::thread thread_without_signals(std::function<void()> work) {
  return std::thread(std::move(work));
}

bool is_terminal(int descriptor) noexcept { return ::_isatty(descriptor) != 0; }

int terminal_columns(int descriptor) noexcept {
  CONSOLE_SCREEN_BUFFER_INFO info = {};
  const auto handle = reinterpret_cast<HANDLE>(::_get_osfhandle(descriptor));
  if (::GetConsoleScreenBufferInfo(handle, &info) == 0) return 0;
  return info.srWindow.Right - info.srWindow.Left + 1;
}

}  // namespace meshrepair::internal
