// SPDX-License-Identifier: MIT
// Notches in the rim of a hole: they are filled before it is joined with another one, as a ring
// would run through them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "rim.h"

namespace meshrepair::internal {

struct FilledNotches {
  // Positions in the rim. All have the direction of the rim.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  double area = 0;                  // of these
  std::vector<std::uint32_t> left;  // positions in the rim, ascending: what is open still
  Rim rim;                          // of these
};

// A triangle over two edges of the rim fills a notch where they meet at an angle below 120 degrees,
// it is small beside the rim, and goes on from the surface. The sharpest come first. Takes n log n.
[[nodiscard]] FilledNotches fill_notches(const Rim& rim);

}  // namespace meshrepair::internal
