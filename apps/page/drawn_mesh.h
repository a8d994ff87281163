// SPDX-License-Identifier: MIT
// What of a mesh a page draws.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <mesh/soup.h>

namespace meshrepair {

struct DrawnMesh {
  TriangleSoup soup;                  // finite
  std::vector<std::uint32_t> kinds;   // of each triangle; none at all: all are 0
  std::vector<std::uint16_t> marks;   // likewise: bit d for Defect d
  std::vector<std::uint32_t> values;  // of each point; none at all: there are none
  std::vector<std::uint32_t> source;  // of each triangle, its number in the mesh; ascending
  bool is_simplified = false;         // not all triangles, or others, are there
};

[[nodiscard]] bool is_finite(const TriangleSoup& soup, std::uint32_t triangle);

// All triangles that are finite, if they are no more than `most`. Else those that have marks, and
// as many others, simplified, as may be drawn beside them; or, where more than `most` have marks,
// every so many of these. `kinds` and `marks` have one entry a triangle, or none.
[[nodiscard]] DrawnMesh drawn_mesh(const TriangleSoup& soup, std::span<const std::uint32_t> kinds,
                                   std::span<const std::uint16_t> marks, std::size_t most);

}  // namespace meshrepair
