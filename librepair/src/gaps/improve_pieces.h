// SPDX-License-Identifier: MIT
// Triangles of a flat region become less thin.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <base/vec3.h>
#include <mesh/edge_table.h>

namespace meshrepair::internal {

using Flat = Eigen::Vector2d;

// Above 0 where a, b, c turn to the left. Rounded.
[[nodiscard]] inline double left_turn(const Flat& a, const Flat& b, const Flat& c) {
  const Flat ab = b - a, ac = c - a;
  return ab.x() * ac.y() - ab.y() * ac.x();
}

// Without the coordinate in which the normal is largest.
class FlatPoints {
 public:
  // The points have to live as long.
  FlatPoints(const std::vector<Vec3d>& points, const Vec3d& normal) : points_(points) {
    Eigen::Index drop = 0;
    normal.cwiseAbs().maxCoeff(&drop);
    u_ = (drop + 1) % 3;
    v_ = (drop + 2) % 3;
    if (normal[drop] < 0) std::swap(u_, v_);
  }

  Flat operator()(std::uint32_t p) const { return {points_[p][u_], points_[p][v_]}; }

 private:
  const std::vector<Vec3d>& points_;
  Eigen::Index u_ = 0, v_ = 1;
};

// Flips edges inside the region, which turns to the left as seen so, where the thinner one of the
// two triangles gets less thin: one that is flat, its corners in a line, goes, unless its longest
// side bounds the region.
void improve_pieces(const FlatPoints& at, std::vector<IndexTriangle>& pieces);

}  // namespace meshrepair::internal
