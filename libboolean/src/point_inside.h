// SPDX-License-Identifier: MIT
// A place that a closed surface is around.
#pragma once

#include <optional>

#include <mesh/soup.h>

namespace meshrepair::internal {

// A point inside the part of space that the triangles bound, which is connected; on none of them,
// and where the surface winds once, exactly. The surface is closed and turned outward from that
// part; where it bounds a void, from the material around it. Nothing where rounding leaves no room
// below any of the largest triangles.
[[nodiscard]] std::optional<Vec3d> point_inside(const TriangleSoup& boundary);

}  // namespace meshrepair::internal
