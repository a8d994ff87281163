// SPDX-License-Identifier: MIT
// Meshes as sets of triangles in space, whatever their indices and their order.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include <mesh/soup.h>

namespace meshrepair::testing {

// Coordinates of the corners, from the lowest corner on.
using PlacedTriangle = std::array<std::array<double, 3>, 3>;

inline PlacedTriangle placed_triangle(const TriangleSoup& mesh, std::size_t t) {
  PlacedTriangle triangle{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d& p = mesh.points[mesh.triangles[t][k]];
    triangle[k] = {p.x(), p.y(), p.z()};
  }
  std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
  return triangle;
}

// Sorted.
inline std::vector<PlacedTriangle> triangles_by_place(const TriangleSoup& mesh) {
  std::vector<PlacedTriangle> all;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) all.push_back(placed_triangle(mesh, t));
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace meshrepair::testing
