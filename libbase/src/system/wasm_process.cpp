// SPDX-License-Identifier: MIT
// WebAssembly has no system: what the one around it can tell, JavaScript says. A page says nothing,
// node what web/package/src/program-worker.js has as `system` of the module.
#include <array>
#include <emscripten/em_js.h>
#include <emscripten/heap.h>
#include <fcntl.h>
#include <filesystem>
#include <unistd.h>
#include <utility>

#include <climits>

#include <base/internal/system.h>

// clang-format off
EM_JS(int, meshrepair_system_is_there, (), { return Module["system"] ? 1 : 0; })
EM_JS(int, meshrepair_request_to_end, (), { return Module["system"] ? Module["system"].requestToEnd() : 0; })
EM_JS(double, meshrepair_cpu_seconds, (), { return Module["system"] ? Module["system"].cpuSeconds() : 0; })
EM_JS(double, meshrepair_free_memory, (), { return Module["system"] ? Module["system"].freeMemory() : -1; })
EM_JS(void, meshrepair_limit_heap, (double bytes), { Module["heapLimit"] = bytes; })
EM_JS(int, meshrepair_terminal_columns, (int descriptor), { return Module["system"] ? Module["system"].columns(descriptor) : 0; })
EM_JS(void, meshrepair_program_file, (char* name, int most), { stringToUTF8(Module["system"] ? Module["system"].programFile : "", name, most); })
// clang-format on

namespace meshrepair::internal {
namespace {

constexpr std::uint64_t kLeast = std::uint64_t{8} << 20;  // beyond what the program has taken

}  // namespace

double cpu_seconds() noexcept { return meshrepair_cpu_seconds(); }

// It is never given back.
std::size_t peak_memory() noexcept { return emscripten_get_heap_size(); }

// A page does many runs in the memory that the largest has left: that is no run's own.
ProcessMemory process_memory() noexcept {
  if (meshrepair_system_is_there() == 0) return {};
  const std::uint64_t bytes = emscripten_get_heap_size();
  return {bytes, bytes, bytes};
}

std::optional<std::uint64_t> free_memory() {
  const double bytes = meshrepair_free_memory();
  if (bytes < 0) return std::nullopt;
  return static_cast<std::uint64_t>(bytes);
}

std::uint64_t limit_process_memory(std::uint64_t bytes, std::size_t /*threads*/) {
  if (meshrepair_system_is_there() == 0) return 0;
  const std::uint64_t used = emscripten_get_heap_size();
  if (bytes < used + kLeast) return used + kLeast;
  meshrepair_limit_heap(static_cast<double>(bytes));
  return 0;
}

void end_process_now(int code) noexcept { _exit(code); }

// That of the module.
std::filesystem::path program_file() {
  std::array<char, PATH_MAX> name = {};
  meshrepair_program_file(name.data(), static_cast<int>(name.size()));
  return name.data();
}

bool is_open(int descriptor) noexcept { return ::fcntl(descriptor, F_GETFD) != -1; }

void handle_request_to_end(int /*number*/, void (* /*handle*/)(int number)) noexcept {}

int request_to_end_without_handler() noexcept { return meshrepair_request_to_end(); }

void prepare_standard_streams() noexcept {}

std::thread thread_without_signals(std::function<void()> work) {
  return std::thread(std::move(work));
}

bool is_terminal(int descriptor) noexcept { return ::isatty(descriptor) == 1; }

int terminal_columns(int descriptor) noexcept { return meshrepair_terminal_columns(descriptor); }

}  // namespace meshrepair::internal
