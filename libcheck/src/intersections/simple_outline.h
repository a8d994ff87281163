// SPDX-License-Identifier: MIT
// Does the outline of a region bound it without crossing itself?
#pragma once

#include <cstdint>
#include <span>

#include <base/vec3.h>

namespace meshrepair::internal {

// A side of a triangle that has no neighbour in the region, in the direction of the triangle.
struct OutlineEdge {
  std::uint32_t from, to;  // corners
  const Vec3d* from_at;
  const Vec3d* to_at;
};

// Seen along the coordinate axis `axis`: whether the edges meet at corners that they share alone,
// and each has the outside on its other side. `turn` is that of the triangles, 1 or -1, as
// orientation_along() gives it. Exact. n log n in the edges.
[[nodiscard]] bool is_simple_outline(std::span<const OutlineEdge> edges, int axis, int turn);

}  // namespace meshrepair::internal
