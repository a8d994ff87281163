// The rim of a hole, as the triangulations over it see it.
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include <bsp/soup.h>

namespace meshrepair::internal {

// Point i and the next one are an edge of a triangle of the surface with the third corner apex[i].
struct Rim {
  std::vector<Vec3d> points;  // three or more, all different
  std::vector<Vec3d> apex;

  [[nodiscard]] std::size_t size() const { return points.size(); }
};

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

// Whether a triangle with the edge `edge` of the rim and this third corner folds back by more than
// 150 degrees: rather onto the surface than on from it.
inline bool is_sharp_fold(const Rim& rim, std::size_t edge, const Vec3d& third) {
  constexpr double kSharp = 0.87;
  return fold_cosine(rim.points[edge], rim.points[(edge + 1) % rim.size()], rim.apex[edge], third) >
         kSharp;
}

}  // namespace meshrepair::internal
