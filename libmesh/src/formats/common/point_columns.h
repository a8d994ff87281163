// SPDX-License-Identifier: MIT
// What the numbers behind x, y and z in the lines of a point file mean.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <mesh/soup.h>

namespace meshrepair {

// A line of a point file; what it has beyond so many numbers means nothing to us.
struct PointLine {
  static constexpr std::size_t kMost = 12;

  std::array<double, kMost> numbers = {};
  std::size_t count = 0;

  [[nodiscard]] Vec3d triple(std::size_t at) const {
    return {numbers[at], numbers[at + 1], numbers[at + 2]};
  }
};

// Positions of triples in a line; 0: there is none.
struct PointColumns {
  std::size_t normal = 0;
  std::size_t colour = 0;
};

// Told by the first lines of a file: three numbers that are a vector of length 1 nearly everywhere
// are a normal, three integers from 0 to 255 a colour.
[[nodiscard]] PointColumns guess_columns(std::span<const PointLine> lines);

// A number of a colour, 0 to 255; others become the nearest of these, and NaN 0.
[[nodiscard]] std::uint8_t to_colour(double value);

}  // namespace meshrepair
