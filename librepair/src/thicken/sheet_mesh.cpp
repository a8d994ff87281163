// SPDX-License-Identifier: MIT
#include "sheet_mesh.h"

#include <algorithm>
#include <span>
#include <utility>

#include <Eigen/Geometry>

#include <base/disjoint_sets.h>
#include <base/ids.h>
#include <repair/orient_parts.h>

namespace meshrepair::internal {
namespace {

class SheetMeshMaker {
 public:
  SheetMeshMaker(const CleanSoup& soup, const std::vector<char>& is_sheet)
      : all_(index_triangles(soup)), is_sheet_(is_sheet), turned_(all_.size(), 0) {
    mesh_.points.assign(soup.points.begin(), soup.points.end());
    for (TriangleId t(0u); t < soup.triangles.end_id(); ++t.value) {
      is_given_.push_back(soup.triangles[t].source != Triangle::kNoSource ? 1 : 0);
      if (is_sheet_[t.index()] == 0) continue;
      mesh_.source.push_back(soup.triangles[t].source);
      number_.push_back(t.value);
    }
  }

  SheetMesh run() {
    pair_sides();
    turn_alike();
    mesh_.triangles.reserve(number_.size());
    for (const std::uint32_t t : number_) {
      mesh_.triangles.push_back(all_[t]);
      if (turned_[t] != 0) std::swap(mesh_.triangles.back()[0], mesh_.triangles.back()[1]);
    }
    set_normals();
    set_joints();
    return std::move(mesh_);
  }

 private:
  // In the numbers of the soup, before triangles are turned.
  void pair_sides() {
    partner_.assign(3 * all_.size(), kNone);
    EdgeTable(all_).for_each_edge([&](std::span<const std::uint32_t> sides) {
      if (sides.size() != 2 || is_sheet_[sides[0] / 3] == 0 || is_sheet_[sides[1] / 3] == 0) return;
      partner_[sides[0]] = sides[1];
      partner_[sides[1]] = sides[0];
    });
  }

  [[nodiscard]] double area(std::uint32_t t) const {
    const auto& [a, b, c] = all_[t];
    const auto& at = mesh_.points;
    return 0.5 * (at[b] - at[a]).cross(at[c] - at[a]).norm();
  }

  void turn_alike() {
    std::vector<char> reached(all_.size(), 0);
    std::vector<std::uint32_t> part;
    for (const std::uint32_t first : number_) {
      if (reached[first] != 0) continue;
      part.assign(1, first);
      reached[first] = 1;
      for (std::size_t i = 0; i < part.size(); ++i) reach_neighbours(part[i], reached, part);
      turn_smaller_half(part);
    }
  }

  void reach_neighbours(std::uint32_t t, std::vector<char>& reached,
                        std::vector<std::uint32_t>& part) {
    for (std::uint32_t side = 3 * t; side < 3 * t + 3; ++side) {
      const std::uint32_t other = partner_[side];
      if (other == kNone || reached[other / 3] != 0) continue;
      const bool differ = side_start(all_, side) != side_start(all_, other);
      turned_[other / 3] = static_cast<char>(differ ? turned_[t] : 1 - turned_[t]);
      reached[other / 3] = 1;
      part.push_back(other / 3);
    }
  }

  void turn_smaller_half(const std::vector<std::uint32_t>& part) {
    double balance = 0;
    for (const std::uint32_t t : part) balance += turned_[t] != 0 ? -area(t) : area(t);
    if (balance >= 0) return;
    for (const std::uint32_t t : part) turned_[t] = static_cast<char>(1 - turned_[t]);
  }

  void set_normals() {
    for (const auto& [a, b, c] : mesh_.triangles) {
      const auto& at = mesh_.points;
      const Vec3d normal = (at[b] - at[a]).cross(at[c] - at[a]);
      mesh_.normal.emplace_back(normal.stableNormalized());
      mesh_.area += 0.5 * normal.norm();
    }
  }

  void set_joints() {
    const std::size_t count = mesh_.triangles.size();
    mesh_.joint.assign(3 * count, Joint::rim);
    mesh_.partner.assign(3 * count, kNone);
    mesh_.many_first.assign(1, 0);
    DisjointSets sets(count);
    // Those of sheets come first, and have the numbers of the mesh.
    std::vector<IndexTriangle> triangles = mesh_.triangles;
    for (std::uint32_t t = 0; t < all_.size(); ++t) {
      if (is_sheet_[t] == 0 && is_given_[t] != 0) triangles.push_back(all_[t]);
    }
    EdgeTable(triangles).for_each_edge([&](std::span<const std::uint32_t> sides) {
      const auto ours = static_cast<std::size_t>(
          std::lower_bound(sides.begin(), sides.end(), static_cast<std::uint32_t>(3 * count)) -
          sides.begin());
      for (std::size_t i = 1; i < ours; ++i) sets.join(sides[0] / 3, sides[i] / 3);
      join(sides, sides.first(ours));
    });
    mesh_.sheets = sets.count();
  }

  void join(std::span<const std::uint32_t> all, std::span<const std::uint32_t> sides) {
    if (all.size() < 2 || sides.empty()) return;
    if (all.size() == 2 && sides.size() == 2) {
      const bool differ =
          side_start(mesh_.triangles, sides[0]) != side_start(mesh_.triangles, sides[1]);
      for (const std::uint32_t side : sides) mesh_.joint[side] = differ ? Joint::same : Joint::seam;
      mesh_.partner[sides[0]] = sides[1];
      mesh_.partner[sides[1]] = sides[0];
      return;
    }
    for (const std::uint32_t side : sides) mesh_.joint[side] = Joint::many;
    mesh_.many_sides.insert(mesh_.many_sides.end(), sides.begin(), sides.end());
    mesh_.many_first.push_back(static_cast<std::uint32_t>(mesh_.many_sides.size()));
    mesh_.many_with_others.push_back(sides.size() < all.size() ? 1 : 0);
  }

  SheetMesh mesh_;
  std::vector<IndexTriangle> all_;
  const std::vector<char>& is_sheet_;
  std::vector<char> is_given_;         // of each triangle of the soup, no patch over a hole
  std::vector<char> turned_;           // of each triangle of the soup
  std::vector<std::uint32_t> number_;  // of each triangle of the sheets its number in the soup
  std::vector<std::uint32_t> partner_;
};

}  // namespace

SheetMesh make_sheet_mesh(const CleanSoup& soup, const std::vector<char>& is_sheet) {
  return SheetMeshMaker(soup, is_sheet).run();
}

}  // namespace meshrepair::internal
