// SPDX-License-Identifier: MIT
// Rays that run up the z axis, and which triangles they pass: exactly, and never along an edge.
//
// A ray that starts at a corner of a triangle starts beside it instead, by four steps, each smaller
// by far than the one before and smaller than any positive number: along the triangle's two sides,
// which leads into its interior, where nothing touches it, then along x and y. One that starts at a
// point takes the last two. A turn that is 0 is decided by the first step that turns it, which
// makes each turn consistent with all others.
#pragma once

#include <array>
#include <cstdint>

#include <check/box_tree.h>
#include <mesh/soup.h>

namespace meshrepair::internal {

// Where a ray starts: beside `corner`, into the triangle that has it and the other two; these are
// `corner` as well for a point of its own.
struct RayStart {
  Vec3d corner, second, third;

  static RayStart at(const Vec3d& point) { return {point, point, point}; }
  static RayStart in(const TriangleSoup& soup, const std::array<std::uint32_t, 3>& t) {
    return {soup.points[t[0]], soup.points[t[1]], soup.points[t[2]]};
  }
};

// 1 if the ray passes from below the triangle, as a, b, c turn seen from above, counter-clockwise,
// -1 if they turn the other way round, 0 if it does not pass it. The start is not on the triangle.
[[nodiscard]] int passed_upward(const Vec3d& a, const Vec3d& b, const Vec3d& c,
                                const RayStart& start);

// Whether the triangle's box is such that the ray may pass it.
[[nodiscard]] inline bool may_reach(const Vec3d& start, const Vec3d& a, const Vec3d& b,
                                    const Vec3d& c) {
  for (Eigen::Index k = 0; k < 2; ++k) {
    if (a[k] < start[k] && b[k] < start[k] && c[k] < start[k]) return false;
    if (a[k] > start[k] && b[k] > start[k] && c[k] > start[k]) return false;
  }
  return a.z() >= start.z() || b.z() >= start.z() || c.z() >= start.z();
}

// Calls visit(item) for all whose boxes the ray may reach.
template <class Visit>
void visit_column(const BoxTree& tree, const Vec3d& start, Visit visit) {
  tree.visit(
      [&](const Box& box) {
        return box.low[0] <= start.x() && start.x() <= box.high[0] && box.low[1] <= start.y() &&
               start.y() <= box.high[1] && start.z() <= box.high[2];
      },
      visit);
}

}  // namespace meshrepair::internal
