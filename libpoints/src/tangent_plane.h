// SPDX-License-Identifier: MIT
// The plane that a surface has at one of its samples, as the points around tell.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <mesh/soup.h>

namespace meshrepair {

struct TangentPlane {
  Vec3d normal = Vec3d::Zero();  // of length 1, either way round
  // Share of the two smaller variances that the smallest one has: 0 in a plane, 1/2 where the
  // points scatter alike to two sides of a line.
  double roughness = 0;
  // Whether the points lie along a line: the normal is then any one across it.
  bool line = false;
};

// The plane of least squares through the neighbours (nearest first, the point not among them),
// weighted by their distance from the point: the last weighs almost nothing.
[[nodiscard]] TangentPlane fit_tangent_plane(const std::vector<Vec3d>& points, std::size_t point,
                                             std::span<const std::uint32_t> neighbours);

}  // namespace meshrepair
