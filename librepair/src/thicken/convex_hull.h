// The convex hull of a few points.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <base/vec3.h>

namespace meshrepair::internal {

// Triangles of indices into `points`, counter-clockwise seen from outside; none where all points
// lie in one plane. Exact. Takes the number of points times that of triangles.
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> convex_hull(std::span<const Vec3d> points);

}  // namespace meshrepair::internal
