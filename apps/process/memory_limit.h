// SPDX-License-Identifier: MIT
// How much memory a run may take.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace meshrepair {

struct MemoryLimit {
  std::uint64_t bytes = 0;  // 0: none
  bool is_share = false;    // of what was free
};

// "200M", "1.5G", "80%", bytes without a unit; units are powers of 1024, "MB" and "MiB" are "M". A
// share is one of what the machine has free, and taken now. 0 is no limit. Throws UsageError.
[[nodiscard]] MemoryLimit parse_memory_limit(const std::string& text);

// The same without shares, of another option, which messages name.
[[nodiscard]] std::uint64_t parse_size(const std::string& text, const std::string& option);

// Makes the system refuse more than this to the process, so that it meets std::bad_alloc in place
// of the system's killer. `threads` are those to be started from now on: what their stacks reserve
// does not count. Throws UsageError if the program needs more than this for itself, LimitError if
// it is a share of too little.
void limit_memory(const MemoryLimit& limit, std::size_t threads);

// "200 MB", for messages.
[[nodiscard]] std::string memory_text(std::uint64_t bytes);

}  // namespace meshrepair
