// SPDX-License-Identifier: MIT
#include "column_ray.h"

#include <exact/double_predicates.h>

namespace meshrepair::internal {
namespace {

int sign_of_difference(double a, double b) { return static_cast<int>(a > b) - (a < b); }

// The turn from a over b to the start seen along z. 0 only if a and b are one. What a step along a
// side adds is the turn to the side's end, as the corner itself adds nothing.
int turn(const Vec3d& a, const Vec3d& b, const RayStart& start) {
  for (const Vec3d* p : {&start.corner, &start.second, &start.third}) {
    const int sign = orientation_along(2, a, b, *p);
    if (sign != 0) return sign;
  }
  const int by_x = sign_of_difference(a.y(), b.y());
  return by_x != 0 ? by_x : sign_of_difference(b.x(), a.x());
}

// 0 only if the start, or all of the triangle that it is in, lies in the plane.
int side_of_plane(const Vec3d& a, const Vec3d& b, const Vec3d& c, const RayStart& start) {
  for (const Vec3d* p : {&start.corner, &start.second, &start.third}) {
    const int sign = orientation(a, b, c, *p);
    if (sign != 0) return sign;
  }
  return 0;
}

}  // namespace

int passed_upward(const Vec3d& a, const Vec3d& b, const Vec3d& c, const RayStart& start) {
  const int upward = turn(a, b, start);
  if (upward == 0 || turn(b, c, start) != upward || turn(c, a, start) != upward) return 0;
  return side_of_plane(a, b, c, start) == -upward ? upward : 0;
}

}  // namespace meshrepair::internal
