// SPDX-License-Identifier: MIT
// The limit is the system's own on private memory (RLIMIT_DATA). It counts what is reserved, not
// what is used, so what is reserved but unused at the start (stacks, and the shadow memory of
// sanitizers) is added, and what the limit does not see (the program's code) is taken off.
#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>
#include <sys/resource.h>
#include <unistd.h>

#include <base/internal/system.h>

namespace meshrepair::internal {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kStackBytes = std::uint64_t{4} << 20;  // of a thread
// What a group without a limit has as one, in pages of the largest number with a sign.
constexpr std::uint64_t kNoLimit = std::uint64_t{1} << 62;
constexpr std::uint64_t kLeast = std::uint64_t{8} << 20;  // beyond what the program has taken

// All of a file of the system, which makes it anew each time that it is asked; empty if there is
// none.
std::string text_of(const fs::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return {};
  std::string text;
  std::array<char, 4096> some{};
  for (ssize_t count = 0; (count = ::read(descriptor, some.data(), some.size())) > 0;) {
    text.append(some.data(), static_cast<std::size_t>(count));
  }
  ::close(descriptor);
  return text;
}

// The number after "KEY" of such a text, one "KEY number" a line; empty if there is none.
std::optional<std::uint64_t> number_of_key(std::string_view text, std::string_view key) {
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    if (!line.starts_with(key)) continue;
    const std::size_t at = line.find_first_of("0123456789", key.size());
    if (at == std::string_view::npos) return std::nullopt;
    return std::strtoull(std::string(line.substr(at)).c_str(), nullptr, 10);
  }
  return std::nullopt;
}

std::optional<std::uint64_t> kilobytes_of_key(std::string_view text, std::string_view key) {
  const auto number = number_of_key(text, key);
  return number ? std::optional(*number * 1024) : std::nullopt;
}

// What a control group leaves: its limit less what it uses, but for the files that it could forget.
std::optional<std::uint64_t> free_in_group(const fs::path& group, std::string_view limit_file,
                                           std::string_view usage_file) {
  const auto limit = number_of_key(text_of(group / limit_file), "");
  if (!limit || *limit > kNoLimit) return std::nullopt;
  const auto used = number_of_key(text_of(group / usage_file), "");
  if (!used) return std::nullopt;
  const std::string all = text_of(group / "memory.stat");
  const std::uint64_t files = number_of_key(all, "inactive_file ").value_or(0) +
                              number_of_key(all, "active_file ").value_or(0);
  const std::uint64_t taken = *used - std::min(*used, files);
  return *limit - std::min(*limit, taken);
}

// In the group and in all above it, of both versions of control groups.
std::uint64_t free_in_groups() {
  std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
  std::ifstream in("/proc/self/cgroup");
  for (std::string line; std::getline(in, line);) {  // "0::/path" or "4:memory:/path"
    const std::size_t first = line.find(':');
    const std::size_t second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controller = line.substr(first + 1, second - first - 1);
    const bool unified = controller.empty();
    if (!unified && controller != "memory") continue;
    const fs::path root = unified ? "/sys/fs/cgroup" : "/sys/fs/cgroup/memory";
    for (fs::path path = line.substr(second + 1);; path = path.parent_path()) {
      const fs::path group = root / path.relative_path();
      const auto free =
          unified ? free_in_group(group, "memory.max", "memory.current")
                  : free_in_group(group, "memory.limit_in_bytes", "memory.usage_in_bytes");
      least = std::min(least, free.value_or(least));
      if (!path.has_relative_path()) break;
    }
  }
  return least;
}

struct Pages {
  unsigned long resident = 0;
  unsigned long shared = 0;  // of files; resident
  unsigned long data = 0;    // private, resident or not
};

// Asked often, by several threads, and by a handler of signals, so with no more than the system's
// own calls. The file is opened each time: in a process that was forked, one that stays open tells
// of its parent.
Pages pages_now() {
  const int file = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  if (file < 0) return {};
  std::array<char, 128> text = {};
  const ssize_t size = ::read(file, text.data(), text.size());
  ::close(file);
  std::array<unsigned long, 6> numbers = {};  // all, resident, shared, code, libraries, data
  const char* at = text.data();
  const char* const end = at + std::max<ssize_t>(size, 0);
  for (unsigned long& number : numbers) {
    const auto [after, error] = std::from_chars(at, end, number);
    if (error != std::errc()) return {};
    at = std::min(after + 1, end);
  }
  return {numbers[1], numbers[2], numbers[5]};
}

std::uint64_t page_bytes() { return static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)); }

}  // namespace

std::optional<std::uint64_t> free_memory() {
  const auto machine = kilobytes_of_key(text_of("/proc/meminfo"), "MemAvailable:");
  if (!machine) return std::nullopt;
  return std::min(*machine, free_in_groups());
}

ProcessMemory process_memory() noexcept {
  const Pages now = pages_now();
  const std::uint64_t bytes = page_bytes();
  return {now.resident * bytes, (now.resident - std::min(now.resident, now.shared)) * bytes,
          now.data * bytes};
}

std::uint64_t limit_process_memory(std::uint64_t bytes, std::size_t threads) {
  const std::string status = text_of("/proc/self/status");
  const auto of_self = [&](std::string_view key) {
    return kilobytes_of_key(status, key).value_or(0);
  };
  const std::uint64_t used = of_self("RssAnon:");
  const std::uint64_t resident = of_self("VmRSS:");
  const std::uint64_t code = resident - std::min(resident, used);
  if (bytes < used + code + kLeast) return used + code + kLeast;
  const std::uint64_t reserved = of_self("VmData:") + of_self("VmStk:");
  const std::uint64_t unused = reserved - std::min(reserved, used);
  rlimit limit = {};
  if (getrlimit(RLIMIT_DATA, &limit) != 0) return 0;
  const rlim_t wanted = bytes - code + unused + threads * kStackBytes;
  limit.rlim_cur = std::min(limit.rlim_cur, wanted);
  setrlimit(RLIMIT_DATA, &limit);
  return 0;
}

}  // namespace meshrepair::internal
