// SPDX-License-Identifier: MIT
#include "dividing_wall.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace meshrepair::internal {
namespace {

struct Division {
  std::size_t both = 0, above = 0, below = 0;

  [[nodiscard]] std::size_t cost() const {
    return 8 * both + std::max(above, below) - std::min(above, below);
  }
  [[nodiscard]] bool is_of_use() const {
    const std::size_t all = both + above + below;
    return 2 * both <= all && 8 * (both + std::max(above, below)) <= 7 * all;
  }
};

// On which sides of the wall clipping would find something of each.
Division divide(std::span<const ClippedTriangle> judges, const Wall& wall) {
  Division division;
  for (const ClippedTriangle& judge : judges) {
    bool above = false, below = false;
    for (const Vec3d& corner : judge.corners()) {
      const double height = wall.height(corner);
      above |= height >= -kClipMargin;
      below |= height <= kClipMargin;
    }
    (above && below ? division.both : above ? division.above : division.below) += 1;
  }
  return division;
}

// Calls visit(wall) for the planes along a triangle, just beside it: what touches them from one
// side is then on that side alone.
template <class Visit>
void visit_walls(const std::array<Vec3d, 3>& triangle, Visit visit) {
  const auto visit_if_it_is_one = [&](const Vec3d& normal, const Vec3d& at) {
    if (!normal.allFinite() || normal.isZero(0)) return;
    visit(Wall{normal, normal.dot(at) - 2 * kClipMargin});
  };
  const Vec3d up = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).stableNormalized();
  visit_if_it_is_one(up, triangle[0]);
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d along = (triangle[k == 2 ? 0 : k + 1] - triangle[k]).stableNormalized();
    visit_if_it_is_one(up.cross(along).stableNormalized(), triangle[k]);
  }
}

}  // namespace

std::optional<Wall> choose_wall(std::span<const std::array<Vec3d, 3>> offered,
                                std::span<const ClippedTriangle> judges) {
  std::optional<Wall> best;
  std::size_t best_cost = 0;
  for (const std::array<Vec3d, 3>& triangle : offered) {
    visit_walls(triangle, [&](const Wall& wall) {
      const Division division = divide(judges, wall);
      if (!division.is_of_use() || (best && division.cost() >= best_cost)) return;
      best = wall;
      best_cost = division.cost();
    });
  }
  return best;
}

}  // namespace meshrepair::internal
