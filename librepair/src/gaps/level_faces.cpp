// SPDX-License-Identifier: MIT
#include "level_faces.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/Geometry>

#include <base/ids.h>

namespace meshrepair::internal {
namespace {

// Of the angle between planes: what is more nearly parallel has no place in common that is near.
constexpr double kAcrossLevels = 0.1;

Vec3d area_of(const TriangleSoup& soup, const IndexTriangle& t) {
  const Vec3d& a = soup.points[t[0]];
  return (soup.points[t[1]] - a).cross(soup.points[t[2]] - a);
}

// Across edges, and across gaps; both ways.
std::vector<std::pair<std::uint32_t, std::uint32_t>> list_neighbours(
    std::span<const IndexTriangle> corners, std::span<const NearFaces> pairs) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> list;
  EdgeTable(corners).for_each_edge([&](std::span<const std::uint32_t> sides) {
    if (sides.size() == 2) list.emplace_back(sides[0] / 3, sides[1] / 3);
  });
  for (const NearFaces& pair : pairs) list.emplace_back(pair.a, pair.b);
  const std::size_t count = list.size();
  for (std::size_t i = 0; i < count; ++i) list.emplace_back(list[i].second, list[i].first);
  std::sort(list.begin(), list.end());
  return list;
}

// The triangles of pairs, the largest first.
std::vector<std::uint32_t> by_area(const TriangleSoup& soup, std::span<const IndexTriangle> corners,
                                   std::span<const NearFaces> pairs) {
  std::vector<std::pair<double, std::uint32_t>> order;
  for (const NearFaces& pair : pairs) {
    for (const std::uint32_t t : {pair.a, pair.b}) {
      order.emplace_back(-area_of(soup, corners[t]).norm(), t);
    }
  }
  std::sort(order.begin(), order.end());
  std::vector<std::uint32_t> triangles;
  triangles.reserve(order.size());
  for (const auto& [area, t] : order) triangles.push_back(t);
  return triangles;
}

}  // namespace

Levels::Levels(const TriangleSoup& soup, std::span<const IndexTriangle> corners,
               std::span<const NearFaces> pairs, double distance)
    : level_of_(corners.size(), kNone) {
  const Neighbours neighbours = list_neighbours(corners, pairs);
  for (const std::uint32_t t : by_area(soup, corners, pairs)) {
    if (level_of_[t] == kNone) grow(t, soup, corners, neighbours, distance);
  }
}

void Levels::grow(std::uint32_t first, const TriangleSoup& soup,
                  std::span<const IndexTriangle> corners, const Neighbours& neighbours,
                  double distance) {
  const auto number = static_cast<std::uint32_t>(levels_.size());
  const Level level = {area_of(soup, corners[first]).normalized(), soup.points[corners[first][0]]};
  levels_.push_back(level);
  const auto is_within = [&](const IndexTriangle& t) {
    const Vec3d area = area_of(soup, t);
    return std::abs(level.normal.dot(area)) >= (1 - kAcrossLevels) * area.norm() &&
           std::all_of(t.begin(), t.end(), [&](std::uint32_t p) {
             return std::abs(level.height_of(soup.points[p])) <= distance;
           });
  };
  level_of_[first] = number;
  std::vector<std::uint32_t> waiting = {first};
  while (!waiting.empty()) {
    const std::uint32_t t = waiting.back();
    waiting.pop_back();
    auto next = std::lower_bound(neighbours.begin(), neighbours.end(), std::pair(t, 0u));
    for (; next != neighbours.end() && next->first == t; ++next) {
      const std::uint32_t other = next->second;
      if (level_of_[other] != kNone || !is_within(corners[other])) continue;
      level_of_[other] = number;
      waiting.push_back(other);
    }
  }
}

void Levels::move_points(std::span<const IndexTriangle> corners, double radius,
                         std::vector<Vec3d>& points) const {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> levels;  // of each point
  for (std::size_t t = 0; t < corners.size(); ++t) {
    if (level_of_[t] == kNone) continue;
    for (const std::uint32_t p : corners[t]) levels.emplace_back(p, level_of_[t]);
  }
  std::sort(levels.begin(), levels.end());
  levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
  for (std::size_t first = 0, last = 0; first < levels.size(); first = last) {
    Vec3d& point = points[levels[first].first];
    while (last < levels.size() && levels[last].first == levels[first].first) ++last;
    const Vec3d place = place_in(std::span(levels).subspan(first, last - first), point);
    if ((place - point).norm() <= radius) point = place;
  }
}

// The nearest place in all planes, but for those nearly parallel to others.
Vec3d Levels::place_in(std::span<const std::pair<std::uint32_t, std::uint32_t>> levels,
                       Vec3d place) const {
  std::vector<Vec3d> ways;
  for (const auto& [point, number] : levels) {
    const Level& level = levels_[number];
    Vec3d way = level.normal;
    for (const Vec3d& other : ways) way -= other.dot(way) * other;
    if (way.norm() < kAcrossLevels) continue;
    way.normalize();
    place -= way * (level.height_of(place) / level.normal.dot(way));
    ways.push_back(way);
  }
  return place;
}

}  // namespace meshrepair::internal
