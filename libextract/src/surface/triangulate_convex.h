// Triangulation of convex polygons that may have vertices inside their sides.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace meshrepair::internal {

struct PolygonCorner {
  std::array<double, 3> position{};  // only for choosing the shorter diagonal
  bool straight = false;             // its two neighbours and it are in a line
};

// Appends n - 2 triangles (indices into `polygon`, in its orientation) without a degenerate one. At
// least three corners are not straight. Linear time.
void triangulate_convex(std::span<const PolygonCorner> polygon,
                        std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace meshrepair::internal
