// SPDX-License-Identifier: MIT
// Around an edge the triangles have directions, and so have the two sides of each. Between two
// triangles that follow each other there is a gap. Where it is wider than half a turn, the walls of
// their sides leave a wedge open between them, which is filled by what is as far from the edge as
// walls are from triangles, a round. Where the gap is narrower, the walls cross, or leave a crack
// where they lean away from each other.
//
// What only touches walls would leave slits, as points are rounded. So each piece reaches into the
// walls on both sides, by half of what they reach from the sheet: all of it is in the round still.
#include "fold_walls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include <Eigen/Geometry>

#include <base/angles.h>

#include "hull_walls.h"
#include "own_walls.h"

namespace meshrepair::internal {
namespace {

// A triangle at an edge.
struct Leaf {
  std::uint32_t side = 0;
  bool along = true;  // it runs from the edge's first end to the other
  Vec3d inward;       // in its plane, at right angles to the edge, of length 1
  double angle = 0;   // of that around the edge
};

// A side of a leaf: the one that is next when going round, or the last one.
struct LeafSide {
  const Leaf* leaf;
  bool next;
  // Seen from the first end, with the triangle's corners from there to the other end, the normal is
  // what comes next, or else before.
  [[nodiscard]] bool is_above() const { return leaf->along == next; }
};

// In narrower gaps the walls of the two triangles cross for sure, though their ends may lean by 15
// degrees each, and nothing is left between them.
constexpr double kSurelyCrossing = 150 * std::numbers::pi / 180;

// The same for walls that do not lean: a crack may be left by rounding alone.
constexpr double kCrossingUpright = std::numbers::pi * (1 - 1e-6);

// What is folded onto itself, as cards are that have two faces, has a rim there as others have it:
// within a degree, which no hinge is.
constexpr double kFoldedBack = 359 * std::numbers::pi / 180;

class FoldMaker {
 public:
  FoldMaker(const SheetMesh& mesh, const CornerOffsets& offsets, const WallReach& reach,
            SheetWalls& walls)
      : mesh_(mesh), offsets_(offsets), reach_(reach), walls_(walls) {}

  std::size_t run() {
    for (std::uint32_t side = 0; side < mesh_.joint.size(); ++side) {
      const bool is_pair = mesh_.joint[side] == Joint::same || mesh_.joint[side] == Joint::seam;
      if (!is_pair || mesh_.partner[side] < side || is_closed(side)) continue;
      const std::array<std::uint32_t, 2> sides = {side, mesh_.partner[side]};
      make_fold(sides, false);
    }
    for (std::size_t i = 0; i + 1 < mesh_.many_first.size(); ++i) {
      const std::uint32_t first = mesh_.many_first[i];
      make_fold({mesh_.many_sides.data() + first, mesh_.many_first[i + 1] - first},
                mesh_.many_with_others[i] != 0);
    }
    return folds_;
  }

  std::vector<FoldEnd> take_ends() { return std::move(ends_); }

 private:
  // Whether one wall, shared by both triangles of the side, is all there is.
  [[nodiscard]] bool is_closed(std::uint32_t side) const {
    const auto has_own = [&](std::uint32_t t) {
      return offsets_.has_own_wall(t, SheetSide::below) ||
             offsets_.has_own_wall(t, SheetSide::above);
    };
    return offsets_.goes_on(mesh_, side) && !has_own(side / 3) && !has_own(mesh_.partner[side] / 3);
  }

  void make_fold(std::span<const std::uint32_t> sides, bool with_others) {
    ++folds_;
    find_leaves(sides);
    if (with_others) round_rims();
    if (leaves_.size() < 2) return;
    for (std::size_t i = 0; i < leaves_.size(); ++i) {
      fill_gap(leaves_[i], leaves_[(i + 1) % leaves_.size()], i + 1 == leaves_.size());
    }
  }

  // In their order around the edge.
  void find_leaves(std::span<const std::uint32_t> sides) {
    const Vec3d& from = mesh_.at(sides[0]);
    const Vec3d along = (mesh_.at(next_side(sides[0])) - from).stableNormalized();
    leaves_.clear();
    for (const std::uint32_t side : sides) {
      Leaf leaf;
      leaf.side = side;
      leaf.along =
          mesh_.triangles[side / 3][side % 3] == mesh_.triangles[sides[0] / 3][sides[0] % 3];
      leaf.inward = (leaf.along ? 1 : -1) * mesh_.normal[side / 3].cross(along);
      leaves_.push_back(leaf);
    }
    const Vec3d u = leaves_[0].inward, v = along.cross(u);
    for (Leaf& leaf : leaves_) leaf.angle = arc_tangent(leaf.inward.dot(v), leaf.inward.dot(u));
    std::stable_sort(leaves_.begin(), leaves_.end(),
                     [](const Leaf& a, const Leaf& b) { return a.angle < b.angle; });
  }

  // From one leaf to the one that is next when going round.
  void fill_gap(const Leaf& a, const Leaf& b, bool is_last) {
    const double turn = b.angle - a.angle + (is_last ? 2 * std::numbers::pi : 0);
    const LeafSide from{&a, true}, to{&b, false};
    const bool any_own = has_own(from) || has_own(to);
    if (!any_own && offsets_.goes_on(mesh_, a.side)) return;
    if (share_own_wall(mesh_, offsets_, a.side, side_of(from))) return;
    const bool has_walls = offsets_.has_wall[a.side / 3] != 0 && offsets_.has_wall[b.side / 3] != 0;
    const double crossing =
        stands_upright(from) && stands_upright(to) ? kCrossingUpright : kSurelyCrossing;
    if (has_walls && (turn < crossing || turn > kFoldedBack)) return;
    const double r = reach_of(from);
    if (!(r > 0) || reach_of(to) != r) return;
    const bool is_round = turn > std::numbers::pi;
    const Vec3d over = -(a.inward + b.inward).stableNormalized();  // where it is round
    std::array<FoldEnd, 2> ends;
    for (const bool first : {true, false}) {
      FoldEnd& end = ends[first ? 0 : 1];
      end.corner = corner_of(a, first);
      const Vec3d& p = mesh_.at(end.corner);
      const Vec3d m = vector_of(from, first), n = vector_of(to, first);
      end.points = {p, p + r * m, p + r * n};
      if (is_round) append_arc(p, r, m, over_at(over, m, n), n, end.points);
    }
    const std::array<std::uint32_t, 2> beside = {a.side, b.side};
    append(ends, beside, r);
  }

  [[nodiscard]] static SheetSide side_of(const LeafSide& side) {
    return side.is_above() ? SheetSide::above : SheetSide::below;
  }

  [[nodiscard]] bool has_own(const LeafSide& side) const {
    return offsets_.has_own_wall(side.leaf->side / 3, side_of(side));
  }

  // Whether the wall's end is at right angles to the triangle.
  [[nodiscard]] bool stands_upright(const LeafSide& side) const {
    const Vec3d& normal = mesh_.normal[side.leaf->side / 3];
    const auto is_normal = [&](bool first) {
      return offsets_.vectors[offsets_.of_corner[corner_of(*side.leaf, first)]] == normal;
    };
    return has_own(side) || (is_normal(true) && is_normal(false));
  }

  // So that walls around edges in a row meet in the same points, that of the vectors alone, where
  // they tell.
  static Vec3d over_at(const Vec3d& over, const Vec3d& m, const Vec3d& n) {
    const Vec3d between = m + n;
    return between.dot(over) > 0.5
               ? Vec3d(between.stableNormalized() * std::sqrt(m.norm() * n.norm()))
               : over;
  }

  // Where others are at the edge, the wall ends in a half of a round, so that no gap is left.
  void round_rims() {
    for (const Leaf& leaf : leaves_) {
      for (const bool next : {true, false}) {
        const LeafSide side{&leaf, next};
        const double r = reach_of(side);
        if (!(r > 0)) continue;
        std::array<FoldEnd, 2> ends;
        for (const bool first : {true, false}) {
          FoldEnd& end = ends[first ? 0 : 1];
          end.corner = corner_of(leaf, first);
          const Vec3d& p = mesh_.at(end.corner);
          const Vec3d m = vector_of(side, first), n = -leaf.inward;
          end.points = {p, p + r * m, p + r * n};
          append_arc(p, r, m, (m + n).stableNormalized(), n, end.points);
        }
        const std::array<std::uint32_t, 1> beside = {leaf.side};
        append(ends, beside, r);
      }
    }
  }

  // Beside these sides.
  void append(std::array<FoldEnd, 2>& ends, std::span<const std::uint32_t> sides, double reach) {
    const Vec3d& a = mesh_.at(ends[0].corner);
    const Vec3d& b = mesh_.at(ends[1].corner);
    ends[0].inner = on_the_way(a, 0.5 * (a + b), reach);
    ends[1].inner = on_the_way(b, 0.5 * (a + b), reach);
    std::vector<Vec3d> points = ends[0].points;
    points.insert(points.end(), ends[1].points.begin(), ends[1].points.end());
    std::vector<std::uint32_t> triangles;
    for (const std::uint32_t side : sides) {
      points.push_back(on_the_way(0.5 * (a + b), mesh_.beyond(side), reach));
      triangles.push_back(side / 3);
    }
    append_hull(mesh_, points, triangles, walls_);
    for (FoldEnd& end : ends) ends_.push_back(std::move(end));
  }

  [[nodiscard]] static std::uint32_t corner_of(const Leaf& leaf, bool first) {
    return leaf.along == first ? leaf.side : next_side(leaf.side);
  }

  [[nodiscard]] double reach_of(const LeafSide& side) const {
    return side.is_above() ? reach_.above : reach_.below;
  }

  // At one of the edge's ends, away from the leaf.
  [[nodiscard]] Vec3d vector_of(const LeafSide& side, bool first) const {
    const std::uint32_t corner = corner_of(*side.leaf, first);
    const Vec3d& vector =
        has_own(side) ? mesh_.normal[corner / 3] : offsets_.vectors[offsets_.of_corner[corner]];
    return side.is_above() ? vector : Vec3d(-vector);
  }

  const SheetMesh& mesh_;
  const CornerOffsets& offsets_;
  const WallReach& reach_;
  SheetWalls& walls_;
  std::vector<Leaf> leaves_;
  std::vector<FoldEnd> ends_;
  std::size_t folds_ = 0;
};

}  // namespace

std::vector<FoldEnd> append_folds(const SheetMesh& mesh, const CornerOffsets& offsets,
                                  const WallReach& reach, SheetWalls& walls,
                                  ThickenReport& report) {
  FoldMaker maker(mesh, offsets, reach, walls);
  report.folds = maker.run();
  return maker.take_ends();
}

}  // namespace meshrepair::internal
