// A ring of triangles between two loops in space.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "rim.h"

namespace meshrepair::internal {

struct StripTriangulation {
  // Positions in `a`, and behind them those in `b`. Triangles with an edge of `a` have its
  // direction, and the others the one that agrees.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  double area = 0;
  bool folded =
      false;  // lies back on the surface at most of the edges: it is no gap that it closes
};

// The ring of least area that has an edge where the two loops come nearest to each other (Fuchs,
// Kedem and Uselton 1977), whatever their directions. Takes the product of their lengths.
[[nodiscard]] StripTriangulation triangulate_strip(const Rim& a, const Rim& b);

}  // namespace meshrepair::internal
