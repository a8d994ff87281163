// SPDX-License-Identifier: MIT
// Numbers as few bytes, for what a page has of a mesh: see pack_mesh.h.
#pragma once

#include <cstdint>
#include <string>

namespace meshrepair {

// Seven bits a byte, the lowest first; the highest bit of a byte says that more follow.
inline void append_number(std::string& out, std::uint32_t value) {
  while (value >= 0x80) {
    out += static_cast<char>(value | 0x80);
    value >>= 7;
  }
  out += static_cast<char>(value);
}

// Twice itself, or twice its amount less one if it is negative.
inline void append_signed(std::string& out, std::int32_t value) {
  const auto bits = static_cast<std::uint32_t>(value);
  append_number(out, (bits << 1) ^ (value < 0 ? ~0u : 0u));
}

}  // namespace meshrepair
