#include "level_faces.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <Eigen/Geometry>

#include <base/ids.h>

namespace meshrepair::internal {
namespace {

// Of the angle between planes: what is more nearly parallel has no place in common that is near.
constexpr double kAcross = 0.1;

struct Level {
  Vec3d normal = Vec3d::Zero();  // of length 1
  Vec3d at = Vec3d::Zero();

  [[nodiscard]] double height_of(const Vec3d& p) const { return normal.dot(p - at); }
};

class Leveller {
 public:
  Leveller(const TriangleSoup& soup, std::span<const IndexTriangle> corners,
           std::span<const NearFaces> pairs, double distance)
      : soup_(soup), corners_(corners), distance_(distance), level_of_(corners.size(), kNone) {
    list_neighbours(pairs);
    for (const std::uint32_t t : by_area(pairs)) {
      if (level_of_[t] == kNone) grow(t);
    }
  }

  [[nodiscard]] std::vector<Vec3d> places(double radius) const {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> levels;  // of each point
    for (std::size_t t = 0; t < corners_.size(); ++t) {
      if (level_of_[t] == kNone) continue;
      for (const std::uint32_t p : corners_[t]) levels.emplace_back(p, level_of_[t]);
    }
    std::sort(levels.begin(), levels.end());
    levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
    std::vector<Vec3d> places = soup_.points;
    for (std::size_t first = 0, last = 0; first < levels.size(); first = last) {
      const std::uint32_t p = levels[first].first;
      while (last < levels.size() && levels[last].first == p) ++last;
      const Vec3d place = place_in(std::span(levels).subspan(first, last - first));
      if ((place - soup_.points[p]).norm() <= radius) places[p] = place;
    }
    return places;
  }

 private:
  [[nodiscard]] Vec3d area_of(std::uint32_t t) const {
    const IndexTriangle& c = corners_[t];
    const Vec3d& a = soup_.points[c[0]];
    return (soup_.points[c[1]] - a).cross(soup_.points[c[2]] - a);
  }

  // Across edges, and across gaps.
  void list_neighbours(std::span<const NearFaces> pairs) {
    EdgeTable(corners_).for_each_edge([&](std::span<const std::uint32_t> sides) {
      if (sides.size() == 2) neighbours_.push_back({sides[0] / 3, sides[1] / 3});
    });
    for (const NearFaces& pair : pairs) neighbours_.push_back({pair.a, pair.b});
    const std::size_t count = neighbours_.size();
    for (std::size_t i = 0; i < count; ++i) {
      neighbours_.push_back({neighbours_[i].second, neighbours_[i].first});
    }
    std::sort(neighbours_.begin(), neighbours_.end());
  }

  // The triangles of pairs, the largest first.
  [[nodiscard]] std::vector<std::uint32_t> by_area(std::span<const NearFaces> pairs) const {
    std::vector<std::pair<double, std::uint32_t>> order;
    for (const NearFaces& pair : pairs) {
      for (const std::uint32_t t : {pair.a, pair.b}) order.emplace_back(-area_of(t).norm(), t);
    }
    std::sort(order.begin(), order.end());
    std::vector<std::uint32_t> triangles;
    for (const auto& [area, t] : order) triangles.push_back(t);
    return triangles;
  }

  void grow(std::uint32_t first) {
    const auto number = static_cast<std::uint32_t>(levels_.size());
    levels_.push_back({area_of(first).normalized(), soup_.points[corners_[first][0]]});
    level_of_[first] = number;
    std::vector<std::uint32_t> waiting = {first};
    while (!waiting.empty()) {
      const std::uint32_t t = waiting.back();
      waiting.pop_back();
      auto next = std::lower_bound(neighbours_.begin(), neighbours_.end(), std::pair(t, 0u));
      for (; next != neighbours_.end() && next->first == t; ++next) {
        const std::uint32_t other = next->second;
        if (level_of_[other] != kNone || !is_within(levels_.back(), other)) continue;
        level_of_[other] = number;
        waiting.push_back(other);
      }
    }
  }

  [[nodiscard]] bool is_within(const Level& level, std::uint32_t t) const {
    const Vec3d area = area_of(t);
    return std::abs(level.normal.dot(area)) >= (1 - kAcross) * area.norm() &&
           std::all_of(corners_[t].begin(), corners_[t].end(), [&](std::uint32_t p) {
             return std::abs(level.height_of(soup_.points[p])) <= distance_;
           });
  }

  // The nearest place of a point in all its planes, but for those nearly parallel to others.
  [[nodiscard]] Vec3d place_in(
      std::span<const std::pair<std::uint32_t, std::uint32_t>> levels) const {
    Vec3d place = soup_.points[levels.front().first];
    std::vector<Vec3d> ways;
    for (const auto& [point, number] : levels) {
      const Level& level = levels_[number];
      Vec3d way = level.normal;
      for (const Vec3d& other : ways) way -= other.dot(way) * other;
      if (way.norm() < kAcross) continue;
      way.normalize();
      place -= way * (level.height_of(place) / level.normal.dot(way));
      ways.push_back(way);
    }
    return place;
  }

  const TriangleSoup& soup_;
  std::span<const IndexTriangle> corners_;
  double distance_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> neighbours_;
  std::vector<Level> levels_;
  std::vector<std::uint32_t> level_of_;  // of each triangle
};

}  // namespace

std::vector<Vec3d> level_faces(const TriangleSoup& soup, std::span<const IndexTriangle> corners,
                               std::span<const NearFaces> pairs, double distance, double radius) {
  return Leveller(soup, corners, pairs, distance).places(radius);
}

}  // namespace meshrepair::internal
