// SPDX-License-Identifier: MIT
#include "flanges.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <Eigen/Geometry>

#include <base/disjoint_sets.h>
#include <base/ids.h>

#include "rim.h"

namespace meshrepair::internal {
namespace {

// Cosines of the angle to the plane of the loop: at the loop, and anywhere on a flange. A funnel is
// steeper.
constexpr double kFlatAtRim = 0.85;
constexpr double kFlatFlange = 0.7;

// Of the loop, by length.
constexpr double kNearlyAll = 0.9;

// Of the largest opening, in area.
constexpr double kSmallestShare = 0.01;

class FlangeFinder {
 public:
  FlangeFinder(const CleanSoup& soup, std::span<const IndexTriangle> triangles,
               const EdgeTable& table, const BoundaryLoops& loops, ProgressObserver* progress)
      : soup_(soup), triangles_(triangles), table_(table), loops_(loops), progress_(progress) {}

  Flanges run() {
    Flanges found;
    std::vector<BorderEdge> border;
    for (std::size_t l = 0; l < loops_.loops(); ++l) {
      const Vec3d normal = area_of_loop(loops_.points_of(l));
      if (!goes_inward(l, normal)) continue;
      if (across_.empty()) find_neighbours();
      if (!find_flange(l, normal)) continue;
      found.is_outer_rim.resize(loops_.loops(), 0);
      found.is_outer_rim[l] = 1;
      const std::size_t first = border.size();
      for (const std::uint32_t t : flange_) add_beginning(t, border);
      add_open_edges(l, first, border);
    }
    found.openings = large_of(walk_border(soup_, triangles_, table_, std::move(border), progress_));
    return found;
  }

 private:
  [[nodiscard]] Vec3d position(std::uint32_t p) const {
    return as_vector(soup_.grid_points[PointId(p)]);
  }

  // Twice the vector area.
  [[nodiscard]] Vec3d area_of_triangle(std::uint32_t t) const {
    const Vec3d a = position(triangles_[t][0]);
    return (position(triangles_[t][1]) - a).cross(position(triangles_[t][2]) - a);
  }

  // Twice the vector area.
  [[nodiscard]] Vec3d area_of_loop(std::span<const std::uint32_t> points) const {
    std::vector<Vec3d> loop;
    for (const std::uint32_t p : points) loop.push_back(position(p));
    return twice_vector_area(loop);
  }

  // Whether the surface does so from nearly all of the loop, nearly in its plane.
  [[nodiscard]] bool goes_inward(std::size_t l, const Vec3d& normal) const {
    const auto points = loops_.points_of(l);
    const auto edges = loops_.edges_of(l);
    const double size = normal.norm();
    double all = 0, inward = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::uint32_t side = loops_.edges[edges[i]].side;
      const Vec3d from = position(points[i]);
      const Vec3d along = position(points[(i + 1) % points.size()]) - from;
      const Vec3d third = position(side_start(triangles_, next_side(next_side(side))));
      const double length = along.norm();
      all += length;
      if (normal.cross(along).dot(third - from) <= 0) continue;
      const Vec3d area = area_of_triangle(side / 3);
      if (std::abs(area.dot(normal)) >= kFlatAtRim * area.norm() * size) inward += length;
    }
    return inward > kNearlyAll * all;
  }

  void find_neighbours() {
    across_.assign(3 * triangles_.size(), kNone);
    DisjointSets sheets(triangles_.size());
    table_.for_each_edge([&](std::span<const std::uint32_t> sides) {
      if (sides.size() != 2) return;
      across_[sides[0]] = sides[1];
      across_[sides[1]] = sides[0];
      sheets.join(sides[0] / 3, sides[1] / 3);
    });
    sheet_of_.resize(triangles_.size());
    sheet_area_.assign(triangles_.size(), 0);
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      sheet_of_[t] = sheets.root(t);
      sheet_area_[sheet_of_[t]] += area_of_triangle(t).norm();
    }
    seen_by_.assign(triangles_.size(), kNone);
  }

  // Puts the triangles of the flange into flange_. False if there is none.
  [[nodiscard]] bool find_flange(std::size_t l, const Vec3d& normal) {
    const double size = normal.norm();
    const auto mark = static_cast<std::uint32_t>(l);
    double projected = 0, area = 0;
    flange_.clear();
    const auto add = [&](std::uint32_t t) {
      if (seen_by_[t] == mark) return;
      const Vec3d own = area_of_triangle(t);
      const double part = std::abs(own.dot(normal)) / size;
      if (part < kFlatFlange * own.norm()) return;
      seen_by_[t] = mark;
      flange_.push_back(t);
      projected += part;
      area += own.norm();
    };
    for (const std::uint32_t e : loops_.edges_of(l)) add(loops_.edges[e].side / 3);
    for (std::size_t i = 0; i < flange_.size(); ++i) {
      if (projected > size) return false;
      for (std::uint32_t side = 3 * flange_[i]; side < 3 * flange_[i] + 3; ++side) {
        if (across_[side] != kNone) add(across_[side] / 3);
      }
    }
    return projected <= size && 2 * area < sheet_area_[sheet_of_[flange_[0]]];
  }

  void add_beginning(std::uint32_t t, std::vector<BorderEdge>& border) const {
    for (std::uint32_t side = 3 * t; side < 3 * t + 3; ++side) {
      const std::uint32_t other = across_[side];
      if (other == kNone || seen_by_[other / 3] == seen_by_[t]) continue;
      const std::uint32_t a = side_start(triangles_, other);
      const std::uint32_t b = side_start(triangles_, next_side(other));
      border.push_back({std::min(a, b), std::max(a, b), other, true});
    }
  }

  // Where holes in the flange reach what it belongs to, their edges there close the loops.
  void add_open_edges(std::size_t l, std::size_t first, std::vector<BorderEdge>& border) const {
    std::vector<std::uint32_t> ends;
    for (std::size_t e = first; e < border.size(); ++e) {
      ends.insert(ends.end(), {border[e].low, border[e].high});
    }
    std::sort(ends.begin(), ends.end());
    const auto is_loose = [&](std::uint32_t p) {
      const auto [from, to] = std::equal_range(ends.begin(), ends.end(), p);
      return (to - from) % 2 != 0;
    };
    if (std::none_of(ends.begin(), ends.end(), is_loose)) return;
    for (std::size_t other = 0; other < loops_.loops(); ++other) {
      const auto points = loops_.points_of(other);
      if (other == l || std::none_of(points.begin(), points.end(), is_loose)) continue;
      for (const std::uint32_t e : loops_.edges_of(other)) {
        const BorderEdge& edge = loops_.edges[e];
        if (edge.open && seen_by_[edge.side / 3] != static_cast<std::uint32_t>(l)) {
          border.push_back(edge);
        }
      }
    }
  }

  // Others are bumps of a flange.
  [[nodiscard]] BoundaryLoops large_of(const BoundaryLoops& all) const {
    std::vector<double> size;
    for (std::size_t l = 0; l < all.loops(); ++l)
      size.push_back(area_of_loop(all.points_of(l)).norm());
    const double largest = size.empty() ? 0 : *std::max_element(size.begin(), size.end());
    BoundaryLoops large;
    large.edges = all.edges;
    for (std::size_t l = 0; l < all.loops(); ++l) {
      if (size[l] < kSmallestShare * largest) continue;
      const auto points = all.points_of(l), edges = all.edges_of(l);
      large.point.insert(large.point.end(), points.begin(), points.end());
      large.edge.insert(large.edge.end(), edges.begin(), edges.end());
      large.first.push_back(large.point.size());
    }
    return large;
  }

  const CleanSoup& soup_;
  std::span<const IndexTriangle> triangles_;
  const EdgeTable& table_;
  const BoundaryLoops& loops_;
  ProgressObserver* progress_;
  std::vector<std::uint32_t> across_;    // of each side: that of the one other triangle there
  std::vector<std::uint32_t> sheet_of_;  // of each triangle
  std::vector<double> sheet_area_;       // of each, twice
  std::vector<std::uint32_t> seen_by_;   // of each triangle: the loop whose flange it is
  std::vector<std::uint32_t> flange_;    // scratch
};

}  // namespace

Flanges find_flanges(const CleanSoup& soup, std::span<const IndexTriangle> triangles,
                     const EdgeTable& table, const BoundaryLoops& loops,
                     ProgressObserver* progress) {
  return FlangeFinder(soup, triangles, table, loops, progress).run();
}

}  // namespace meshrepair::internal
