// SPDX-License-Identifier: MIT
// The box around a soup.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <check/box_tree.h>
#include <mesh/soup.h>

namespace meshrepair::internal {

// Around its triangles.
inline Box box_of(const TriangleSoup& soup) {
  Box box;
  for (const auto& triangle : soup.triangles) {
    for (const std::uint32_t point : triangle) box.add(soup.points[point]);
  }
  return box;
}

inline double longest_side(const Box& box) {
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k) longest = std::max(longest, box.high[k] - box.low[k]);
  return longest;
}

}  // namespace meshrepair::internal
