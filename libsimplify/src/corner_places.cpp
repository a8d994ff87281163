// SPDX-License-Identifier: MIT
#include "corner_places.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include <base/ids.h>
#include <check/internal/nearest_triangle.h>
#include <mesh/edge_table.h>

namespace meshrepair::internal {
namespace {

// Around a point, many triangles may be as near as one another, with a nearer one behind them.
constexpr std::size_t kMostLookedAt = 48;  // since the last that was nearer

}  // namespace

CornerPlaces::CornerPlaces(std::span<const IndexTriangle> triangles, std::vector<Vec3d> points,
                           std::span<const std::uint8_t> seams)
    : triangles_(triangles.begin(), triangles.end()),
      points_(std::move(points)),
      beyond_(triangles.size(), {kNone, kNone, kNone}),
      triangle_of_(3 * triangles.size()),
      looked_at_by_(triangles.size(), 0) {
  EdgeTable(triangles).for_each_edge([&](std::span<const std::uint32_t> sides) {
    const auto is_seam = [&](std::uint32_t s) { return (seams[s / 3] >> s % 3 & 1) != 0; };
    if (sides.size() != 2 || (!seams.empty() && is_seam(sides[0]))) return;
    beyond_[sides[0] / 3][sides[0] % 3] = sides[1] / 3;
    beyond_[sides[1] / 3][sides[1] % 3] = sides[0] / 3;
  });
  for (std::uint32_t c = 0; c < triangle_of_.size(); ++c) triangle_of_[c] = c / 3;
}

std::array<Vec3d, 3> CornerPlaces::corners_of(std::uint32_t triangle) const {
  const auto& [a, b, c] = triangles_[triangle];
  return {points_[a], points_[b], points_[c]};
}

void CornerPlaces::move(std::span<const std::uint32_t> corners, const Vec3d& place) {
  const std::uint32_t nearest = nearest_from(nearest_of(corners, place), place);
  for (const std::uint32_t corner : corners) triangle_of_[corner] = nearest;
}

bool CornerPlaces::is_within(std::span<const std::uint32_t> corners, const Vec3d& place,
                             double most_squared) {
  const std::uint32_t nearest = nearest_from(nearest_of(corners, place), place, most_squared);
  return squared_distance(place, corners_of(nearest)) <= most_squared;
}

// Of those that the corners lie on.
std::uint32_t CornerPlaces::nearest_of(std::span<const std::uint32_t> corners,
                                       const Vec3d& place) const {
  std::uint32_t nearest = triangle_of_[corners[0]];
  double least = squared_distance(place, corners_of(nearest));
  for (const std::uint32_t corner : corners.subspan(1)) {
    const std::uint32_t t = triangle_of_[corner];
    if (t == nearest) continue;
    const double distance = squared_distance(place, corners_of(t));
    if (distance < least) std::tie(nearest, least) = std::pair(t, distance);
  }
  return nearest;
}

std::uint32_t CornerPlaces::nearest_from(std::uint32_t triangle, const Vec3d& place,
                                         double enough_squared) {
  ++search_;
  std::uint32_t nearest = triangle;
  double least = squared_distance(place, corners_of(triangle));
  looked_at_by_[triangle] = search_;
  to_look_at_.assign(1, triangle);
  if (least <= enough_squared) return nearest;
  for (std::size_t i = 0; i < to_look_at_.size() && to_look_at_.size() < kMostLookedAt; ++i) {
    for (const std::uint32_t t : beyond_[to_look_at_[i]]) {
      if (t == kNone || looked_at_by_[t] == search_) continue;
      looked_at_by_[t] = search_;
      const double distance = squared_distance(place, corners_of(t));
      if (distance < least) {  // all that is farther is forgotten
        if (distance <= enough_squared) return t;
        std::tie(nearest, least) = std::pair(t, distance);
        to_look_at_.assign(1, t);
        i = ~std::size_t{0};
        break;
      }
      to_look_at_.push_back(t);
    }
  }
  return nearest;
}

Vec3d CornerPlaces::nearest(std::uint32_t corner, const Vec3d& place) const {
  const std::array<Vec3d, 3> corners = corners_of(triangle_of_[corner]);
  const bool is_corner = std::find(corners.begin(), corners.end(), place) != corners.end();
  return is_corner ? place : nearest_point(place, corners);
}

}  // namespace meshrepair::internal
