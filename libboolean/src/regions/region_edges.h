// SPDX-License-Identifier: MIT
// Whether regions follow each other around edges.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <mesh/soup.h>

#include "region_complex.h"

namespace meshrepair::internal {

// A triangle at an edge, seen along it.
struct EdgePage {
  std::uint32_t apex = 0;       // its third corner
  std::uint32_t clockwise = 0;  // what is next to it that way
  std::uint32_t counter = 0;    // and what the other way
  int half = 0;                 // of sorting only
};

// Whether what one comes to behind a triangle, going round the edge from a to b, is not what is
// before the next one, or two triangles leave the edge in one direction, or one has no area. Exact.
// Sorts the pages.
[[nodiscard]] bool is_turned(const std::vector<Vec3d>& points, std::uint32_t a, std::uint32_t b,
                             std::vector<EdgePage>& pages);

// How a triangle is one that passes the edge from a to b, or from b to a.
[[nodiscard]] EdgePage page_at(std::uint32_t a, std::uint32_t b,
                               const std::array<std::uint32_t, 3>& corners,
                               const std::array<std::uint32_t, 2>& sides);

// The edges that are turned, once for each: a triangle there. Where there are none, each region is
// on its side of all triangles that bound it. n log n.
[[nodiscard]] std::vector<std::uint32_t> triangles_at_turned_edges(const TriangleSoup& mesh,
                                                                   const TriangleSides& sides);

}  // namespace meshrepair::internal
