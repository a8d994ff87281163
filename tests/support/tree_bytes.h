// SPDX-License-Identifier: MIT
// The bytes of a .bsp file taken apart, to damage them with a purpose.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "random_geometry.h"

namespace meshrepair::testing {

inline constexpr std::size_t kHeaderBytes = 16;
inline constexpr std::size_t kSectionHeaderBytes = 24;
template <class Number>
inline Number number_at(std::string_view bytes, std::size_t at) {
  Number number;
  std::memcpy(&number, bytes.data() + at, sizeof(number));
  return number;
}

template <class Number>
inline void put_at(std::string& bytes, std::size_t at, Number number) {
  std::memcpy(bytes.data() + at, &number, sizeof(number));
}

// The rule of tree_io.h, written down a second time on purpose.
inline std::uint64_t checksum(std::string_view bytes) {
  std::uint64_t hash = 0xCBF29CE484222325u;
  for (std::size_t i = 0; i < bytes.size(); i += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + i, std::min<std::size_t>(8, bytes.size() - i));
    hash = (hash ^ word) * 0x100000001B3u;
    hash ^= hash >> 32;
  }
  return hash;
}

struct Section {
  std::size_t header = 0;  // position of its header
  std::size_t begin = 0, end = 0;
};

// Where the sections of an intact file are.
inline std::vector<Section> sections_of(std::string_view bytes) {
  std::vector<Section> sections;
  std::size_t at = kHeaderBytes;
  while (at < bytes.size()) {
    Section s;
    s.header = at;
    s.begin = at + kSectionHeaderBytes;
    s.end = s.begin + number_at<std::uint32_t>(bytes, at + 4) *
                          static_cast<std::size_t>(number_at<std::uint64_t>(bytes, at + 8));
    sections.push_back(s);
    at = s.end;
  }
  return sections;
}

inline void mend_checksum(std::string& bytes, const Section& s) {
  put_at(bytes, s.header + 16, checksum(std::string_view(bytes).substr(s.begin, s.end - s.begin)));
}

// Up to three bytes of one section changed, and its checksum mended.
inline void damage_section(std::string& bytes, Random& random) {
  const std::vector<Section> sections = sections_of(bytes);
  const Section& s = sections[static_cast<std::size_t>(
      random.integer(0, static_cast<std::int32_t>(sections.size()) - 1))];
  if (s.begin == s.end) return;
  for (std::int32_t flips = random.integer(1, 3); flips > 0; --flips) {
    const auto at = s.begin + static_cast<std::size_t>(random.integer(
                                  0, static_cast<std::int32_t>(s.end - s.begin) - 1));
    bytes[at] = random.chance(0.5) ? static_cast<char>(bytes[at] ^ (1 << random.integer(0, 7)))
                                   : static_cast<char>(random.integer(-128, 127));
  }
  mend_checksum(bytes, s);
}

}  // namespace meshrepair::testing
