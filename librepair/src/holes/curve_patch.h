// SPDX-License-Identifier: MIT
// A patch that goes on as the surface around the hole does.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "loop_triangulation.h"
#include "refine_patch.h"
#include "rim.h"

namespace meshrepair::internal {

// The triangles of the surface with a corner on the rim: they tell how it arrives there.
struct Collar {
  std::vector<Vec3d> points;  // of the surface, not on the rim
  // Positions on the rim, and from rim.size() on in `points`.
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

// Gives the patch points of its own and bends it to a surface that leaves the rim as the surface
// around it arrives there: first to one of least bending (Liepa 2003, section 5, with the cotangent
// Laplacian), then to one of even mean curvature, as a sphere has it, where that is sound. Nothing
// where the flat patch is as good or better: the rim is short, the surface goes on straight, or it
// arrives so steeply that what is missing is rather a face of its own, as the lid of a box. So is
// what a ragged cut leaves, unless `from_cuts`.
[[nodiscard]] std::optional<PatchMesh> curve_patch(const Rim& rim, const LoopTriangulation& flat,
                                                   const Collar& collar, bool from_cuts,
                                                   const std::function<void()>& poll);

}  // namespace meshrepair::internal
