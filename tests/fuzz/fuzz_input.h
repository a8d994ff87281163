// SPDX-License-Identifier: MIT
// The bytes of a fuzzer read as numbers, and how a target says that something does not hold.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <span>
#include <string>

#include <base/parallel.h>

namespace meshrepair::testing {

// Numbers from front to back; zeros once the bytes are used up. A number takes the same bytes
// whatever came before, so that a mutation has a local meaning.
class FuzzInput {
 public:
  FuzzInput(const std::uint8_t* data, std::size_t size) : rest_(data, size) {}

  [[nodiscard]] bool empty() const { return rest_.empty(); }
  std::uint8_t byte() { return number<std::uint8_t>(); }
  // 0 to count - 1.
  std::size_t below(std::size_t count) { return byte() % count; }

  template <class Number>
  Number number() {
    Number value{};
    const std::size_t size = std::min(sizeof(value), rest_.size());
    if (size > 0) std::memcpy(&value, rest_.data(), size);
    rest_ = rest_.subspan(size);
    return value;
  }

 private:
  std::span<const std::uint8_t> rest_;
};

// Ends the process; the fuzzer keeps the input.
inline void require(bool holds, const std::string& what) {
  if (holds) return;
  std::fprintf(stderr, "finding: %s\n", what.c_str());
  std::abort();
}

// One thread: runs repeat themselves exactly, and many can share a machine. One in each target.
inline const ThreadLimit kOneThread(1);

}  // namespace meshrepair::testing
