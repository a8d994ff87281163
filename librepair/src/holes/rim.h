// SPDX-License-Identifier: MIT
// The rim of a hole, as the triangulations over it see it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <mesh/internal/triangle_measures.h>

namespace meshrepair::internal {

// Point i and the next one are an edge of a triangle of the surface with the third corner apex[i].
struct Rim {
  std::vector<Vec3d> points;  // three or more, all different
  std::vector<Vec3d> apex;

  [[nodiscard]] std::size_t size() const { return points.size(); }
};

// The vector area of a loop, twice: any surface over the loop has it, and at least as much area.
inline Vec3d twice_vector_area(std::span<const Vec3d> loop) {
  Vec3d sum = Vec3d::Zero();
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    sum += (loop[i] - loop[0]).cross(loop[i + 1] - loop[0]);
  }
  return sum;
}

inline double length_of(const Rim& rim) {
  double sum = 0;
  for (std::size_t i = 0; i < rim.size(); ++i) {
    sum += (rim.points[(i + 1) % rim.size()] - rim.points[i]).norm();
  }
  return sum;
}

// Whether a triangle with the edge `edge` of the rim and this third corner folds back by more than
// 150 degrees: rather onto the surface than on from it.
inline bool is_sharp_fold(const Rim& rim, std::size_t edge, const Vec3d& third) {
  constexpr double kSharp = 0.87;
  return fold_cosine(rim.points[edge], rim.points[(edge + 1) % rim.size()], rim.apex[edge], third) >
         kSharp;
}

}  // namespace meshrepair::internal
