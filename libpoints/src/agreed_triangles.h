// SPDX-License-Identifier: MIT
// Of the triangles that stars want, those that lie beside each other.
//
// Where stars disagree, on the diagonal of four points for one, triangles lie on each other. Around
// each point, seen along its normal, triangles are sectors; one is taken only if its sector is free
// at all three of its corners. What is taken is then a manifold with holes, in which at most two
// triangles meet in an edge and one fan in a point. Those that most corners want come first.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <base/progress.h>
#include <mesh/soup.h>

#include "tangent_plane.h"

namespace meshrepair {

struct VotedTriangle {
  std::array<std::uint32_t, 3> corners;
  std::uint8_t votes = 0;
  float size = 0;  // the smaller first, of those with as many votes
};

// Puts what is taken into the order in which it was. Throws Cancelled.
[[nodiscard]] std::vector<VotedTriangle> agreed_triangles(const std::vector<Vec3d>& points,
                                                          const std::vector<TangentPlane>& planes,
                                                          const std::vector<VotedTriangle>& wanted,
                                                          ProgressObserver* progress);

}  // namespace meshrepair
