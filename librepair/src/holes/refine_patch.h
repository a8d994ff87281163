// SPDX-License-Identifier: MIT
// New points inside a patch, at its rim as dense as those of the rim.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include <mesh/soup.h>

namespace meshrepair::internal {

struct PatchMesh {
  std::vector<Vec3d> points;  // those of the rim, then the new ones
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

// Puts points into the middles of triangles that are large beside the edges of the rim around them,
// and turns edges where that makes angles less acute (Liepa 2003, section 4, after Pfeifle and
// Seidel, but coarser inwards). `patch` is a triangulation of a loop: its points are the rim in
// order. At most `most_points` points in the end, or a few more. `poll`, unless empty, may throw.
void refine_patch(PatchMesh& patch, std::size_t most_points, const std::function<void()>& poll);

}  // namespace meshrepair::internal
