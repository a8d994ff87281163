// SPDX-License-Identifier: MIT
// The head of an OFF file: keyword, dimension and counts.
#pragma once

#include <cstddef>
#include <string_view>

#include <mesh/mesh_source.h>

#include "formats/common/text_scanner.h"

namespace meshrepair {

struct OffHeader {
  bool has_keyword = false;
  bool texture = false;      // ST: 2 numbers after each point
  bool color = false;        // C: 4 numbers
  bool normal = false;       // N: 3 numbers
  bool homogeneous = false;  // 4: a fourth coordinate, by which the others are divided
  bool dimension = false;    // n: the dimension comes before the counts
  bool binary = false;
  std::uint64_t points = 0;  // as promised
  std::uint64_t faces = 0;
  bool counts_end_line = true;  // false: data follow on the line of the counts
  std::size_t data_at =
      0;  // position of the byte behind the counts (text), the keyword line (binary)

  // How many numbers the keyword promises for each point.
  [[nodiscard]] std::size_t numbers_per_point() const {
    return 3 + (homogeneous ? 1u : 0u) + (normal ? 3u : 0u) + (color ? 4u : 0u) +
           (texture ? 2u : 0u);
  }
};

inline constexpr TextDialect kOffText = {.comment = '#'};

// Reads the keyword from the first token; returns how many of its characters belong to it, 0 if it
// is none.
std::size_t parse_off_keyword(std::string_view token, OffHeader& header);

// Throws InputError, with the line, where there are no counts. The counts of a binary file are not
// read.
[[nodiscard]] OffHeader read_off_header(const MeshSource& source);

}  // namespace meshrepair
