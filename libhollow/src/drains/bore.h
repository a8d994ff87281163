// SPDX-License-Identifier: MIT
// What a bore through a wall leaves of the solid around it.
//
// The surface around the mouth is what the drill comes through: what faces it, as far as it hangs
// together, with small relief. All else is another part of the surface, and has to keep its wall.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "common/depth.h"

namespace meshrepair::internal {

struct BoreSize {
  double wall = 0;      // of the cavity
  double diameter = 0;  // of the cylinder
};

// The prism that is drilled for a cylinder is not wider than this, as a share.
inline constexpr double kWidestPrism = 1.005;

struct Bore {
  double length = 0;  // from the mouth: its whole section has passed the wall there
  double reach = 0;   // out of the mouth, from 0.5 diameters on; 0: it is not free outside
  // From below, the least distance of the prism from other parts of the surface; below 0 where it
  // cuts them. At most a little more than the wall.
  double beside = 0;
  // Where less than a wall is left: from there away, at right angles to the bore, of length 1.
  Vec3d away = Vec3d::Zero();
  std::size_t looked_at = 0;  // triangles, for the work it took
};

// At the mouth, which is on the triangle at this position of Depth::triangles(), in the direction
// `inward` of length 1. Nothing where the surface there does not face the drill, or where the bore
// does not get through the wall.
[[nodiscard]] std::optional<Bore> bore_at(const Depth& depth, const Vec3d& mouth,
                                          const Vec3d& inward, std::uint32_t position,
                                          const BoreSize& size);

// At right angles to the axis and to each other, of length 1.
struct Across {
  Vec3d u = Vec3d::Zero(), v = Vec3d::Zero();
};
[[nodiscard]] Across across(const Vec3d& axis);

}  // namespace meshrepair::internal
