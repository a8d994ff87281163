// SPDX-License-Identifier: MIT
// How flat a rim is, and how steeply the surface arrives there.
#pragma once

#include "rim.h"

namespace meshrepair::internal {

// The plane through the middle of the rim's points that has the direction of its vector area.
struct RimPlane {
  Vec3d normal = Vec3d::Zero();
  double mean_distance = 0;  // of the points from it: the root of the mean square
  double farthest = 0;       // of them
};

[[nodiscard]] RimPlane plane_of(const Rim& rim);

// Between the surface at the rim and the plane, up to a right angle, weighted by the lengths of the
// edges.
[[nodiscard]] double mean_angle(const Rim& rim, const RimPlane& plane);

// The share of the rim's length at which that angle is larger than `angle`.
[[nodiscard]] double share_steeper(const Rim& rim, const RimPlane& plane, double angle);

}  // namespace meshrepair::internal
