// SPDX-License-Identifier: MIT
// Triangles, bisected until they are small. A triangle that is bisected is halved from the middle
// of its longest side, so triangles that share a side have the same points on it, and the halves
// have half the area, without rounding.
#pragma once

#include <array>
#include <cstdint>

#include <mesh/soup.h>

namespace meshrepair::internal {

struct TrianglePiece {
  // The pieces of a triangle are ascending, and none is on another's path.
  static constexpr int kMostDepth = 60;

  std::array<Vec3d, 3> corners;
  int depth = 0;           // how often it was halved
  std::uint64_t path = 0;  // bit 63 - d says which half it was at depth d

  [[nodiscard]] Vec3d middle() const { return (corners[0] + corners[1] + corners[2]) / 3; }
  // Of its share of the area of the triangle: 2^-depth.
  [[nodiscard]] double share() const;
  // Squared, of the longest side, and the corner that it begins at.
  [[nodiscard]] double longest_side(std::size_t& begin) const;
  // Before it is small enough: no side is longer than the square root of this.
  [[nodiscard]] bool is_to_halve(double square) const;
  [[nodiscard]] std::array<TrianglePiece, 2> halves() const;
};

// The path of the piece that has this point of the triangle.
[[nodiscard]] std::uint64_t path_to(const Vec3d& point, const std::array<Vec3d, 3>& triangle,
                                    double square);

}  // namespace meshrepair::internal
