// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include <base/roots.h>
#include <check/internal/segments.h>

namespace meshrepair::internal {

// As in C. Ericson, "Real-time collision detection", 5.1.9.
Segment shortest_between(const Segment& a, const Segment& b) {
  const Vec3d along_a = a.to - a.from, along_b = b.to - b.from, between = a.from - b.from;
  const double aa = along_a.squaredNorm(), bb = along_b.squaredNorm(), ab = along_a.dot(along_b);
  const double ac = along_a.dot(between), bc = along_b.dot(between);
  const double area = aa * bb - ab * ab;
  double s = area > 0 ? std::clamp((ab * bc - ac * bb) / area, 0.0, 1.0) : 0;
  double t = bb > 0 ? (ab * s + bc) / bb : 0;
  if (t < 0 || t > 1 || bb == 0) {
    t = std::clamp(t, 0.0, 1.0);
    s = aa > 0 ? std::clamp((ab * t - ac) / aa, 0.0, 1.0) : 0;
  }
  return {a.from + s * along_a, b.from + t * along_b};
}

double distance_of_lines(const Segment& a, const Segment& b) {
  const Vec3d across = (a.to - a.from).cross(b.to - b.from);
  return std::abs(across.dot(a.from - b.from)) / stable_length(across);
}

}  // namespace meshrepair::internal
