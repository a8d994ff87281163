// SPDX-License-Identifier: MIT
// Areas of triangles, and angles between them.
#pragma once

#include <Eigen/Geometry>

#include <base/vec3.h>

namespace meshrepair::internal {

inline double triangle_area(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  return 0.5 * (b - a).cross(c - a).norm();
}

// How sharply the surface folds at the edge p q between triangles with the third corners a and b:
// the cosine of the angle between them; 1 where one lies on the other, -1 where it goes straight
// on. 0 for triangles without area.
inline double fold_cosine(const Vec3d& p, const Vec3d& q, const Vec3d& a, const Vec3d& b) {
  const Vec3d u = (q - p).cross(a - p);
  const Vec3d v = (q - p).cross(b - p);
  const double lengths = u.norm() * v.norm();
  return lengths > 0 ? u.dot(v) / lengths : 0;
}

}  // namespace meshrepair::internal
