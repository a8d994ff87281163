// SPDX-License-Identifier: MIT
// A place is made of rings of triangles around those at fault. Its rims are closed by cones whose
// tips lie behind the surface, as deep as the place is wide. A cap that meets something is tried
// with other depths, and then the place gets another ring.
#include "capped_places.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include <Eigen/Geometry>

#include <base/disjoint_sets.h>
#include <base/ids.h>
#include <check/self_intersections.h>
#include <mesh/edge_table.h>

namespace meshrepair::internal {
namespace {

// Rings around the triangles at fault, at first and at most.
constexpr std::size_t kRings = 2, kMostRings = 4;
// Rounds in which rims that meet themselves in a point are filled up.
constexpr std::size_t kMostFills = 8;
// Of the depth of a place and its radius.
constexpr std::array<double, 4> kDepths = {1, 0.25, 4, 0.05};
// Of all caps together.
constexpr std::size_t kMostTries = 8;

// A closed line of corners of the soup, with the place on its left.
struct Rim {
  std::vector<std::uint32_t> corners;
  std::uint32_t place = 0;  // its lowest triangle
  std::size_t depth = 0;    // the one that is tried
};

class PlaceCapper {
 public:
  PlaceCapper(const TriangleSoup& mesh, std::size_t most, Precision precision,
              ProgressObserver* progress)
      : mesh_(mesh),
        most_(most),
        precision_(precision),
        quiet_(progress),
        is_around_(mesh.points.size(), 0) {}

  std::optional<CappedPlaces> run(std::span<const std::uint32_t> seeds) {
    for (const std::uint32_t t : seeds) mark(t);
    for (std::size_t ring = 1; ring < kRings; ++ring) grow([](std::uint32_t) { return true; });
    for (std::size_t rings = kRings; rings <= kMostRings; ++rings) {
      if (!cut_out()) return std::nullopt;
      if (cap()) return std::move(capped_);
      std::vector<char> fails(capped_.soup.points.size(), 0);
      for (const Rim& rim : rims_) {
        if (rim.depth < kDepths.size()) continue;
        for (const std::uint32_t p : rim.corners) fails[p] = 1;
      }
      std::vector<char> in_mesh(mesh_.points.size(), 0);
      for (std::uint32_t p = 0; p < capped_.point.size(); ++p) in_mesh[capped_.point[p]] = fails[p];
      grow([&](std::uint32_t p) { return in_mesh[p] != 0; });
    }
    return std::nullopt;
  }

 private:
  void mark(std::uint32_t triangle) {
    for (const std::uint32_t p : mesh_.triangles[triangle]) is_around_[p] = 1;
  }

  [[nodiscard]] bool is_in_place(const IndexTriangle& t) const {
    return is_around_[t[0]] != 0 || is_around_[t[1]] != 0 || is_around_[t[2]] != 0;
  }

  // One ring more at the corners for which that holds.
  template <class May>
  void grow(const May& may) {
    std::vector<char> marks = is_around_;
    for (const IndexTriangle& t : mesh_.triangles) {
      if (!is_in_place(t) || !(may(t[0]) || may(t[1]) || may(t[2]))) continue;
      for (const std::uint32_t p : t) marks[p] = 1;
    }
    is_around_ = std::move(marks);
  }

  // The triangles that have a marked corner, and the rims.
  bool cut_out() {
    for (std::size_t fill = 0; fill < kMostFills; ++fill) {
      list_triangles();
      if (capped_.triangle.size() > most_) return false;
      if (find_rims()) return true;
    }
    return false;
  }

  void list_triangles() {
    capped_ = {};
    std::vector<std::uint32_t> number(mesh_.points.size(), kNone);
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      IndexTriangle corners = mesh_.triangles[t];
      if (!is_in_place(corners)) continue;
      for (std::uint32_t& p : corners) {
        if (number[p] == kNone) {
          number[p] = static_cast<std::uint32_t>(capped_.point.size());
          capped_.point.push_back(p);
          capped_.soup.points.push_back(mesh_.points[p]);
        }
        p = number[p];
      }
      capped_.triangle.push_back(t);
      capped_.soup.triangles.push_back(corners);
    }
  }

  // False where a rim passes a corner twice: then that corner is marked.
  bool find_rims() {
    const std::vector<IndexTriangle>& triangles = capped_.soup.triangles;
    DisjointSets places(triangles.size());
    std::vector<std::uint32_t> next(capped_.point.size(), kNone);
    std::vector<std::uint32_t> triangle_at(capped_.point.size(), kNone);
    bool is_simple = true;
    EdgeTable(triangles).for_each_edge([&](std::span<const std::uint32_t> sides) {
      if (sides.size() == 2) return places.join(sides[0] / 3, sides[1] / 3);
      const std::uint32_t from = side_start(triangles, sides[0]);
      if (next[from] != kNone) {
        is_simple = false;
        is_around_[capped_.point[from]] = 1;
      }
      next[from] = side_start(triangles, next_side(sides[0]));
      triangle_at[from] = sides[0] / 3;
    });
    rims_.clear();
    if (!is_simple) return false;
    for (std::uint32_t first = 0; first < next.size(); ++first) {
      if (next[first] == kNone) continue;
      Rim& rim = rims_.emplace_back();
      rim.place = places.root(triangle_at[first]);
      for (std::uint32_t p = first; next[p] != kNone; p = std::exchange(next[p], kNone)) {
        rim.corners.push_back(p);
      }
    }
    lowest_.assign(triangles.size(), {});
    for (std::uint32_t t = 0; t < triangles.size(); ++t) lowest_[places.root(t)].push_back(t);
    return true;
  }

  // Whether all rims have a cap that meets nothing.
  bool cap() {
    const std::size_t triangles = capped_.triangle.size(), points = capped_.point.size();
    for (std::size_t round = 0; round < kMostTries; ++round) {
      capped_.soup.triangles.resize(triangles);
      capped_.soup.points.resize(points);
      std::vector<std::uint32_t> caps, rim_of;
      for (std::uint32_t r = 0; r < rims_.size(); ++r) {
        if (rims_[r].depth >= kDepths.size()) return false;
        add_cone(rims_[r]);
        rim_of.resize(capped_.soup.triangles.size() - triangles, r);
      }
      for (std::size_t c = 0; c < rim_of.size(); ++c) {
        caps.push_back(static_cast<std::uint32_t>(triangles + c));
      }
      if (caps.empty()) return true;
      SelfIntersectionOptions options;
      options.most_pairs = 64 * caps.size();
      options.progress = &quiet_;
      const SelfIntersections found = self_intersections(capped_.soup, caps, options);
      if (found.degenerate + found.not_finite > 0) return false;
      if (found.count == 0) return true;
      std::vector<char> fails(rims_.size(), 0);
      for (const auto& pair : found.pairs) {
        for (const std::uint32_t t : pair) {
          if (t >= triangles) fails[rim_of[t - triangles]] = 1;
        }
      }
      const bool is_last = round + 1 == kMostTries;
      for (std::size_t r = 0; r < rims_.size(); ++r) {
        if (fails[r] != 0) rims_[r].depth = is_last ? kDepths.size() : rims_[r].depth + 1;
      }
    }
    return false;
  }

  void add_cone(const Rim& rim) {
    TriangleSoup& soup = capped_.soup;
    Vec3d middle = Vec3d::Zero(), area = Vec3d::Zero();
    for (const std::uint32_t p : rim.corners) middle += soup.points[p];
    middle /= static_cast<double>(rim.corners.size());
    double radius = 0, lowest = 0;
    const std::size_t count = rim.corners.size();
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3d from = soup.points[rim.corners[i]] - middle;
      const Vec3d to = soup.points[rim.corners[i + 1 == count ? 0 : i + 1]] - middle;
      area += from.cross(to);
      radius = std::max(radius, from.norm());
    }
    const Vec3d out = area.stableNormalized();
    for (const std::uint32_t t : lowest_[rim.place]) {
      for (const std::uint32_t p : soup.triangles[t]) {
        lowest = std::min(lowest, out.dot(soup.points[p] - middle));
      }
    }
    const auto tip = static_cast<std::uint32_t>(soup.points.size());
    soup.points.push_back(
        rounded_to(middle + (1.5 * lowest - kDepths[rim.depth] * radius) * out, precision_));
    for (std::size_t i = 0; i < count; ++i) {
      soup.triangles.push_back({rim.corners[i + 1 == count ? 0 : i + 1], rim.corners[i], tip});
    }
  }

  const TriangleSoup& mesh_;
  const std::size_t most_;
  const Precision precision_;
  CancelOnly quiet_;
  std::vector<char> is_around_;  // of each point of the mesh: its triangles are in a place
  CappedPlaces capped_;
  std::vector<Rim> rims_;
  std::vector<std::vector<std::uint32_t>> lowest_;  // of the lowest triangle of a place: all of it
};

}  // namespace

std::optional<CappedPlaces> cap_places(const TriangleSoup& mesh,
                                       std::span<const std::uint32_t> seeds, std::size_t most,
                                       Precision precision, ProgressObserver* progress) {
  return PlaceCapper(mesh, most, precision, progress).run(seeds);
}

}  // namespace meshrepair::internal
