// SPDX-License-Identifier: MIT
// At a point where the sheet has a tip, its walls leave open what is nearest to the point: the
// directions that lead away from all edges there, the normal cone. The hull of the folds' ends and
// of some of these directions fills it. All of it is within the ball around the point, and reaches
// into the walls of folds and triangles there.
#include "corner_walls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <utility>

#include <Eigen/Geometry>

#include <base/disjoint_sets.h>

#include "hull_walls.h"

namespace meshrepair::internal {
namespace {

std::vector<Vec3d> icosahedron() {
  const double long_side = (1 + std::sqrt(5.0)) / 2;
  std::vector<Vec3d> corners;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-long_side, long_side}) {
      corners.emplace_back(0, a, b);
      corners.emplace_back(a, b, 0);
      corners.emplace_back(b, 0, a);
    }
  }
  for (Vec3d& corner : corners) corner.normalize();
  return corners;
}

// 162 directions. Those beside each other are 16 to 19 degrees apart, so that the flat pieces
// between them are within kMostBeside of the sphere.
std::vector<Vec3d> even_directions() {
  std::vector<Vec3d> all = icosahedron();
  // The middles of neighbours, twice; those of others are farther apart.
  for (const double nearest : {0.44, 0.8}) {
    const std::size_t count = all.size();
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = i + 1; j < count; ++j) {
        if (all[i].dot(all[j]) > nearest) all.emplace_back((all[i] + all[j]).normalized());
      }
    }
  }
  return all;
}

class CornerMaker {
 public:
  CornerMaker(const SheetMesh& mesh, const WallReach& reach, const std::vector<FoldEnd>& folds,
              SheetWalls& walls)
      : mesh_(mesh), reach_(reach), folds_(folds), walls_(walls), fan_(mesh.joint.size()) {}

  std::size_t run() {
    join_fans();
    std::map<std::uint32_t, std::vector<const FoldEnd*>> ends;
    for (const FoldEnd& end : folds_) ends[fan_.root(end.corner)].push_back(&end);
    if (ends.empty()) return 0;
    std::map<std::uint32_t, std::vector<std::uint32_t>> corners;
    for (std::uint32_t corner = 0; corner < mesh_.joint.size(); ++corner) {
      const std::uint32_t root = fan_.root(corner);
      if (ends.contains(root)) corners[root].push_back(corner);
    }
    std::size_t made = 0;
    for (const auto& [root, of_fan] : corners) made += make_corner(of_fan, ends.at(root)) ? 1 : 0;
    return made;
  }

 private:
  void join(std::uint32_t side, std::uint32_t other) {
    const bool alike = mesh_.triangles[side / 3][side % 3] == mesh_.triangles[other / 3][other % 3];
    fan_.join(side, alike ? other : next_side(other));
    fan_.join(next_side(side), alike ? next_side(other) : other);
  }

  void join_fans() {
    for (std::uint32_t side = 0; side < mesh_.joint.size(); ++side) {
      const bool is_pair = mesh_.joint[side] == Joint::same || mesh_.joint[side] == Joint::seam;
      if (is_pair && side < mesh_.partner[side]) join(side, mesh_.partner[side]);
    }
    for (std::size_t i = 0; i + 1 < mesh_.many_first.size(); ++i) {
      const std::uint32_t first = mesh_.many_first[i];
      for (std::uint32_t k = first + 1; k < mesh_.many_first[i + 1]; ++k) {
        join(mesh_.many_sides[first], mesh_.many_sides[k]);
      }
    }
  }

  // Nothing is to be done at the end of a single fold.
  [[nodiscard]] static bool meet(const std::vector<const FoldEnd*>& ends) {
    return std::any_of(ends.begin(), ends.end(),
                       [&](const FoldEnd* end) { return end->inner != ends[0]->inner; });
  }

  bool make_corner(std::span<const std::uint32_t> corners,
                   const std::vector<const FoldEnd*>& ends) {
    if (!meet(ends)) return false;
    const Vec3d& p = mesh_.at(corners[0]);
    points_.assign(1, p);
    beside_.clear();
    for (const FoldEnd* end : ends) {
      points_.insert(points_.end(), end->points.begin(), end->points.end());
      points_.push_back(end->inner);
    }
    const double reach = std::max(reach_.below, reach_.above);
    for (const std::uint32_t corner : corners) {
      beside_.push_back(corner / 3);
      const Vec3d opposite = 0.5 * (mesh_.at(next_side(corner)) + mesh_.beyond(corner));
      points_.push_back(on_the_way(p, opposite, reach));
    }
    add_directions(p, corners);
    append_hull(mesh_, points_, beside_, walls_);
    return true;
  }

  // Rims are not round.
  [[nodiscard]] bool has_rim(std::span<const std::uint32_t> corners) const {
    return std::any_of(corners.begin(), corners.end(), [&](std::uint32_t corner) {
      return mesh_.joint[corner] == Joint::rim ||
             mesh_.joint[next_side(next_side(corner))] == Joint::rim;
    });
  }

  void add_directions(const Vec3d& p, std::span<const std::uint32_t> corners) {
    if (has_rim(corners)) return;
    Vec3d above = Vec3d::Zero();
    for (const std::uint32_t corner : corners) above += mesh_.normal[corner / 3];
    for (const Vec3d& d : directions_) {
      const double r = d.dot(above) > 0 ? reach_.above : reach_.below;
      const bool leads_away =
          std::all_of(corners.begin(), corners.end(), [&](std::uint32_t corner) {
            return d.dot(mesh_.at(next_side(corner)) - p) < 0 &&
                   d.dot(mesh_.beyond(corner) - p) < 0;
          });
      if (leads_away && r > 0) points_.emplace_back(p + r * d);
    }
  }

  const SheetMesh& mesh_;
  const WallReach& reach_;
  const std::vector<FoldEnd>& folds_;
  SheetWalls& walls_;
  DisjointSets fan_;
  const std::vector<Vec3d> directions_ = even_directions();
  std::vector<Vec3d> points_;
  std::vector<std::uint32_t> beside_;
};

}  // namespace

void append_corners(const SheetMesh& mesh, const WallReach& reach,
                    const std::vector<FoldEnd>& folds, SheetWalls& walls, ThickenReport& report) {
  report.corners = CornerMaker(mesh, reach, folds, walls).run();
}

}  // namespace meshrepair::internal
