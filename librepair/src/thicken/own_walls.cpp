// SPDX-License-Identifier: MIT
#include "own_walls.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include <base/disjoint_sets.h>
#include <base/ids.h>

namespace meshrepair::internal {
namespace {

// The cosine of an angle of a millionth: what is in one plane looks so once it is rounded.
constexpr double kInOnePlane = 1 - 0.5e-12;

class OwnWallMaker {
 public:
  OwnWallMaker(const SheetMesh& mesh, const CornerOffsets& offsets, const WallReach& reach,
               SheetSide side, SheetWalls& walls)
      : mesh_(mesh),
        offsets_(offsets),
        side_(side),
        along_(side == SheetSide::below ? -reach.below : reach.above),
        walls_(walls),
        planes_(mesh.triangles.size()) {}

  void run() {
    for (std::uint32_t side = 0; side < mesh_.joint.size(); ++side) {
      if (is_shared(side)) planes_.join(side / 3, mesh_.partner[side] / 3);
    }
    find_normals();
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (offsets_.has_own_wall(t, side_)) make_wall(t);
    }
  }

 private:
  [[nodiscard]] bool is_shared(std::uint32_t side) const {
    return share_own_wall(mesh_, offsets_, side, side_);
  }

  void find_normals() {
    normal_.assign(mesh_.triangles.size(), Vec3d::Zero());
    for (std::uint32_t t = 0; t < normal_.size(); ++t) normal_[planes_.root(t)] += mesh_.normal[t];
    for (Vec3d& normal : normal_) normal = normal.stableNormalized();
  }

  void make_wall(std::uint32_t t) {
    std::array<std::uint32_t, 3> on_sheet{}, moved{};
    for (std::uint32_t k = 0; k < 3; ++k) {
      on_sheet[k] = point_of(t, k, false);
      moved[k] = point_of(t, k, true);
    }
    const auto& low = side_ == SheetSide::below ? moved : on_sheet;
    const auto& high = side_ == SheetSide::below ? on_sheet : moved;
    add(t, high);
    add(t, {low[0], low[2], low[1]});
    for (std::uint32_t k = 0; k < 3; ++k) {
      if (is_shared(3 * t + k)) continue;
      const std::uint32_t next = (k + 1) % 3;
      add(t, {low[k], low[next], high[next]});
      add(t, {low[k], high[next], high[k]});
    }
  }

  std::uint32_t point_of(std::uint32_t t, std::uint32_t k, bool is_moved) {
    const std::uint32_t plane = planes_.root(t), point = mesh_.triangles[t][k];
    const auto next = static_cast<std::uint32_t>(walls_.soup.points.size());
    const auto [found, is_new] = numbers_.try_emplace({plane, point, is_moved ? 1u : 0u}, next);
    if (is_new) {
      walls_.soup.points.emplace_back(mesh_.points[point] +
                                      (is_moved ? along_ : 0.0) * normal_[plane]);
    }
    return found->second;
  }

  void add(std::uint32_t t, const std::array<std::uint32_t, 3>& corners) {
    walls_.soup.triangles.push_back(corners);
    walls_.source.push_back(mesh_.source[t]);
  }

  const SheetMesh& mesh_;
  const CornerOffsets& offsets_;
  const SheetSide side_;
  const double along_;
  SheetWalls& walls_;
  DisjointSets planes_;
  std::vector<Vec3d> normal_;  // of each plane
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> numbers_;
};

}  // namespace

void append_own_walls(const SheetMesh& mesh, const CornerOffsets& offsets, const WallReach& reach,
                      SheetWalls& walls) {
  for (const SheetSide side : kSheetSides) OwnWallMaker(mesh, offsets, reach, side, walls).run();
}

bool share_own_wall(const SheetMesh& mesh, const CornerOffsets& offsets, std::uint32_t side,
                    SheetSide of) {
  if (mesh.joint[side] != Joint::same) return false;
  const std::uint32_t t = side / 3, other = mesh.partner[side] / 3;
  return offsets.has_own_wall(t, of) && offsets.has_own_wall(other, of) &&
         mesh.normal[t].dot(mesh.normal[other]) >= kInOnePlane;
}

}  // namespace meshrepair::internal
