// SPDX-License-Identifier: MIT
// Numbers out of binary files.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace meshrepair {

// The number at `bytes`, which need not be aligned, stored in the given order.
template <class Number>
[[nodiscard]] Number load(const char* bytes, std::endian order) {
  std::array<char, sizeof(Number)> raw;
  std::memcpy(raw.data(), bytes, sizeof raw);
  if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
  return std::bit_cast<Number>(raw);
}

}  // namespace meshrepair
