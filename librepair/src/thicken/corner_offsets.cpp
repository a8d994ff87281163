// SPDX-License-Identifier: MIT
// A wall that is as thick everywhere has its corners where the offset planes of the triangles
// around them meet. Of more than three planes no point is in all, so each corner gets the vector
// that least squares find, each plane weighted by the angle of its triangle there, and drawn a
// little to the mean normal in directions about which the planes say nothing. Where that leaves a
// plane too far beside, its largest error is evened out over both sides of it; where that is too
// much, as at sharp folds, each triangle goes along its own normal, and the gap is closed by other
// walls (fold_walls.h).
//
// A narrow triangle is turned over by vectors that differ by little. So vectors near each other are
// made more alike, the nearest most, as far as the planes allow, and at last vectors are halved
// until no triangle is turned over; where that leaves a wall short of its thickness, the triangle
// has one of its own (own_walls.h). Whether one is turned over, exact predicates decide.
#include "corner_offsets.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <base/angles.h>
#include <base/disjoint_sets.h>
#include <base/ids.h>
#include <exact/double_predicates.h>
#include <repair/thicken_sheets.h>

namespace meshrepair::internal {
namespace {

// The planes of two triangles meet this much farther from their edge than they are from the
// triangles: 1 / cos 15 degrees, at a fold of 30.
constexpr double kSharpFold = 0.86602540378443865;  // the cosine of the angle of the normals

// Of the sum of the weights: what keeps a vector near the mean normal in the directions that the
// triangles say nothing about, and little enough not to be seen in those that they do.
constexpr double kTowardsMean = 1e-4;

// What is left then is as thin as what rounding does.
constexpr std::size_t kMostHalvings = 20;

// Rounds of evening out; most of what it can do is done in a few.
constexpr std::size_t kMostEvenings = 24;

// How far a vector goes towards what its neighbours say, as far as its triangles allow.
constexpr std::array<double, 3> kWayShares = {1.0, 0.5, 0.25};

// Points near each other are next to each other along it, and hardly ever all of a plane.
const Vec3d kAcross = {1.0, 0.618, 0.382};

class OffsetFinder {
 public:
  OffsetFinder(const SheetMesh& mesh, const WallReach& reach)
      : mesh_(mesh), reach_(reach), group_(3 * mesh.triangles.size()) {}

  CornerOffsets run() {
    join_corners();
    result_.of_corner.assign(3 * mesh_.triangles.size(), kNone);
    set_common_vectors();
    list_corners();
    result_.reach[0].assign(result_.vectors.size(), reach_.below);
    result_.reach[1].assign(result_.vectors.size(), reach_.above);
    even_out();
    for (const SheetSide side : kSheetSides) shorten(side);
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      result_.has_wall.push_back(
          is_upright(t, places(t, SheetSide::below, 1), places(t, SheetSide::above, 1)) ? 1 : 0);
    }
    return std::move(result_);
  }

 private:
  void join_corners() {
    for (std::uint32_t side = 0; side < mesh_.joint.size(); ++side) {
      if (mesh_.joint[side] != Joint::same) continue;
      const std::uint32_t other = mesh_.partner[side];
      if (other < side) continue;
      if (mesh_.normal[side / 3].dot(mesh_.normal[other / 3]) < kSharpFold) continue;
      group_.join(side, next_side(other));
      group_.join(next_side(side), other);
    }
  }

  void set_common_vectors() {
    std::vector<std::uint32_t> corners(result_.of_corner.size());
    std::iota(corners.begin(), corners.end(), std::uint32_t{0});
    std::stable_sort(corners.begin(), corners.end(), [&](std::uint32_t a, std::uint32_t b) {
      return group_.root(a) < group_.root(b);
    });
    for (std::size_t i = 0; i < corners.size();) {
      const std::size_t first = i;
      while (i < corners.size() && group_.root(corners[i]) == group_.root(corners[first])) ++i;
      const std::span<const std::uint32_t> group(corners.data() + first, i - first);
      std::optional<Vec3d> vector = common_vector(group);
      if (group.size() > 1) vector = fitting(group, *vector);
      for (const std::uint32_t corner : group) {
        if (vector) result_.of_corner[corner] = static_cast<std::uint32_t>(result_.vectors.size());
        if (!vector) set_own_vector(corner);
      }
      if (vector) result_.vectors.push_back(*vector);
    }
  }

  // As long as all planes allow: where they do not, the planes that it is farthest beside are to be
  // as far beside it on both sides. Nothing where that is too far.
  [[nodiscard]] std::optional<Vec3d> fitting(std::span<const std::uint32_t> group,
                                             Vec3d vector) const {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const std::uint32_t corner : group) {
      const double along = vector.dot(mesh_.normal[corner / 3]);
      least = std::min(least, along);
      most = std::max(most, along);
    }
    double length = vector.norm(), factor = 1;
    const auto fits = [&] {
      return factor * least >= 1 - kMostBeside && factor * most <= 1 + kMostBeside &&
             factor * length <= 1 + kMostBeside;
    };
    if (fits()) return vector;
    if (!(least > 0)) return std::nullopt;
    factor = std::min(2 / (least + most), (1 + kMostBeside) / length);
    if (!fits()) return std::nullopt;
    return Vec3d(factor * vector);
  }

  // Least squares: all planes at distance 1, each weighted by the angle that its triangle has
  // there.
  [[nodiscard]] Vec3d common_vector(std::span<const std::uint32_t> group) const {
    if (group.size() == 1) return mesh_.normal[group[0] / 3];
    Vec3d sum = Vec3d::Zero();
    double weights = 0;
    Eigen::Matrix3d system = Eigen::Matrix3d::Zero();
    for (const std::uint32_t corner : group) {
      const double weight = angle_at(corner);
      const Vec3d& normal = mesh_.normal[corner / 3];
      system += weight * normal * normal.transpose();
      sum += weight * normal;
      weights += weight;
    }
    const Vec3d mean = sum.stableNormalized();
    const double along = sum.dot(mean) / weights;
    if (!(along > 0)) return mesh_.normal[group[0] / 3];
    system += kTowardsMean * weights * Eigen::Matrix3d::Identity();
    return system.inverse() * (sum + kTowardsMean * weights / along * mean);
  }

  [[nodiscard]] double angle_at(std::uint32_t corner) const {
    const Vec3d& p = mesh_.at(corner);
    const Vec3d u = mesh_.at(next_side(corner)) - p, v = mesh_.beyond(corner) - p;
    return arc_tangent(u.cross(v).norm(), u.dot(v));
  }

  void set_own_vector(std::uint32_t corner) {
    result_.of_corner[corner] = static_cast<std::uint32_t>(result_.vectors.size());
    result_.vectors.push_back(mesh_.normal[corner / 3]);
  }

  void list_corners() {
    first_corner_.assign(result_.vectors.size() + 1, 0);
    for (const std::uint32_t vector : result_.of_corner) ++first_corner_[vector + 1];
    std::partial_sum(first_corner_.begin(), first_corner_.end(), first_corner_.begin());
    std::vector<std::uint32_t> next(first_corner_.begin(), first_corner_.end() - 1);
    corners_.resize(result_.of_corner.size());
    for (std::uint32_t c = 0; c < corners_.size(); ++c) corners_[next[result_.of_corner[c]]++] = c;
  }

  [[nodiscard]] std::span<const std::uint32_t> corners_of(std::uint32_t vector) const {
    return std::span(corners_).subspan(first_corner_[vector],
                                       first_corner_[vector + 1] - first_corner_[vector]);
  }

  // A triangle that is narrow beside its wall is turned over by vectors that differ by little. So
  // those of its corners go nearer to those beside them, the nearest ones most.
  void even_out() {
    std::vector<std::uint32_t> all(mesh_.triangles.size());
    std::iota(all.begin(), all.end(), 0u);
    std::vector<std::uint32_t> turned = turned_over(all);
    for (std::size_t round = 0; round < kMostEvenings && !turned.empty(); ++round) {
      std::vector<std::uint32_t> near;
      for (const std::uint32_t vector : vectors_of(turned)) {
        if (!go_with_neighbours(vector)) continue;
        for (const std::uint32_t corner : corners_of(vector)) near.push_back(corner / 3);
      }
      if (near.empty()) return;
      near.insert(near.end(), turned.begin(), turned.end());
      sort_unique(near);
      turned = turned_over(near);
    }
  }

  [[nodiscard]] std::vector<std::uint32_t> turned_over(
      std::span<const std::uint32_t> triangles) const {
    std::vector<std::uint32_t> turned;
    for (const std::uint32_t t : triangles) {
      const bool upright = std::all_of(kSheetSides.begin(), kSheetSides.end(), [&](SheetSide side) {
        return result_.reach_at(3 * t, side) == 0 || is_upright_half(t, side);
      });
      if (!upright) turned.push_back(t);
    }
    return turned;
  }

  [[nodiscard]] std::vector<std::uint32_t> vectors_of(
      std::span<const std::uint32_t> triangles) const {
    std::vector<std::uint32_t> vectors;
    for (const std::uint32_t t : triangles) {
      for (std::uint32_t c = 3 * t; c < 3 * t + 3; ++c) vectors.push_back(result_.of_corner[c]);
    }
    sort_unique(vectors);
    return vectors;
  }

  static void sort_unique(std::vector<std::uint32_t>& list) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }

  // Whether it may.
  bool go_with_neighbours(std::uint32_t vector) {
    const std::span<const std::uint32_t> corners = corners_of(vector);
    if (corners.size() == 1) return false;
    Vec3d sum = Vec3d::Zero();
    double weights = 0;
    for (const std::uint32_t corner : corners) {
      const std::uint32_t next = next_side(corner);
      for (const std::uint32_t other : {next, next_side(next)}) {
        const double weight = 1 / (mesh_.at(other) - mesh_.at(corner)).squaredNorm();
        sum += weight * result_.vectors[result_.of_corner[other]];
        weights += weight;
      }
    }
    Vec3d& now = result_.vectors[vector];
    for (const double way : kWayShares) {
      const auto moved = fitting(corners, now + way * (sum / weights - now));
      if (!moved) continue;
      now = *moved;
      return true;
    }
    return false;
  }

  // Halves what vectors reach on one side until no triangle is turned over.
  void shorten(SheetSide side) {
    const auto number = static_cast<std::size_t>(side);
    const double all = side == SheetSide::below ? reach_.below : reach_.above;
    std::vector<double>& reach = result_.reach[number];
    result_.has_own[number].assign(mesh_.triangles.size(), 0);
    if (all == 0) return;
    for (std::size_t halvings = 0; halvings < kMostHalvings; ++halvings) {
      const std::vector<double> before = reach;
      for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
        if (is_upright_half(t, side)) continue;
        for (std::uint32_t c = 3 * t; c < 3 * t + 3; ++c) {
          const std::uint32_t vector = result_.of_corner[c];
          reach[vector] = std::min(reach[vector], before[vector] / 2);
        }
      }
      if (reach == before) break;
    }
    for (std::uint32_t corner = 0; corner < result_.of_corner.size(); ++corner) {
      if (reach[result_.of_corner[corner]] < all) result_.has_own[number][corner / 3] = 1;
    }
  }

  using Places = std::array<Vec3d, 3>;

  // Of the triangle's corners, by this share of the way from the sheet to the side.
  [[nodiscard]] Places places(std::uint32_t t, SheetSide side, double share) const {
    Places moved;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t corner = 3 * t + k;
      const double along = share * result_.reach_at(corner, side);
      moved[k] = mesh_.at(corner) + (side == SheetSide::below ? -along : along) *
                                        result_.vectors[result_.of_corner[corner]];
    }
    return moved;
  }

  [[nodiscard]] bool is_upright_half(std::uint32_t t, SheetSide side) const {
    const Places sheet = places(t, side, 0), moved = places(t, side, 1);
    return side == SheetSide::below ? is_upright(t, moved, sheet) : is_upright(t, sheet, moved);
  }

  // The wall of a triangle is three tetrahedra, cut along the diagonals of its sides, each of which
  // begins below the corner that comes first along a line. None of them may be turned over. Of a
  // narrow triangle the diagonals of both long sides begin at the same end.
  [[nodiscard]] bool is_upright(std::uint32_t t, Places low, Places high) const {
    std::array<std::pair<double, std::uint32_t>, 3> order;
    for (std::uint32_t k = 0; k < 3; ++k) {
      order[k] = {kAcross.dot(mesh_.at(3 * t + k)), mesh_.triangles[t][k]};
    }
    const auto first = std::min_element(order.begin(), order.end()) - order.begin();
    std::rotate(low.begin(), low.begin() + first, low.end());
    std::rotate(high.begin(), high.begin() + first, high.end());
    std::rotate(order.begin(), order.begin() + first, order.end());
    if (orientation(low[0], high[1], high[2], high[0]) <= 0) return false;
    if (order[1] < order[2]) {
      return orientation(low[0], low[1], low[2], high[2]) > 0 &&
             orientation(low[0], low[1], high[2], high[1]) > 0;
    }
    return orientation(low[0], low[1], low[2], high[1]) > 0 &&
           orientation(low[0], high[1], low[2], high[2]) > 0;
  }

  const SheetMesh& mesh_;
  const WallReach& reach_;
  DisjointSets group_;
  std::vector<std::uint32_t> first_corner_, corners_;  // of each vector its corners
  CornerOffsets result_;
};

}  // namespace

bool CornerOffsets::goes_on(const SheetMesh& mesh, std::uint32_t side) const {
  if (mesh.joint[side] != Joint::same) return false;
  const std::uint32_t other = mesh.partner[side];
  return has_wall[side / 3] != 0 && has_wall[other / 3] != 0 &&
         of_corner[side] == of_corner[next_side(other)] &&
         of_corner[next_side(side)] == of_corner[other];
}

CornerOffsets find_corner_offsets(const SheetMesh& mesh, const WallReach& reach) {
  return OffsetFinder(mesh, reach).run();
}

}  // namespace meshrepair::internal
