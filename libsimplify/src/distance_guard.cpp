// SPDX-License-Identifier: MIT
#include "distance_guard.h"

#include <limits>
#include <tuple>
#include <utility>

#include <base/ids.h>
#include <check/internal/nearest_triangle.h>

namespace meshrepair::internal {

DistanceGuard::DistanceGuard(std::vector<Vec3d> points, std::span<const IndexTriangle> triangles,
                             double most)
    : given_(std::move(points)),
      most_squared_(most * most),
      first_(triangles.size(), kNone),
      next_(given_.size(), kNone),
      hangs_(given_.size(), 0) {
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = triangles[t][k], b = triangles[t][(k + 1) % 3];
      if (a > b) continue;
      next_.push_back(std::exchange(first_[t], static_cast<std::uint32_t>(given_.size())));
      given_.emplace_back(0.5 * (given_[a] + given_[b]));
    }
  }
}

void DistanceGuard::list_points(const Collapse& collapse) {
  listed_.clear();
  const auto list = [&](std::uint32_t triangle) {
    for (std::uint32_t p = first_[triangle]; p != kNone; p = next_[p]) listed_.push_back(p);
  };
  for (const auto& t : collapse.fan) list(t.triangle);
  for (const std::uint32_t t : collapse.gone) list(t);
  for (const std::uint32_t p : {collapse.from, collapse.to}) {
    if (hangs_[p] == 0) listed_.push_back(p);
  }
}

bool DistanceGuard::allows(const Collapse& collapse, std::span<const Vec3d> points) {
  list_points(collapse);
  nearest_.clear();
  for (const std::uint32_t p : listed_) {
    double least = std::numeric_limits<double>::infinity();
    std::uint32_t nearest = 0;
    for (std::uint32_t i = 0; i < collapse.fan.size(); ++i) {
      const auto& t = collapse.fan[i];
      const double distance =
          squared_distance(given_[p], {collapse.place, points[t.next], points[t.last]});
      if (distance < least) std::tie(least, nearest) = std::pair(distance, i);
    }
    if (!(least <= most_squared_)) return false;
    nearest_.push_back(nearest);
  }
  return true;
}

void DistanceGuard::note_made(const Collapse& collapse) {
  for (const auto& t : collapse.fan) first_[t.triangle] = kNone;
  for (const std::uint32_t t : collapse.gone) first_[t] = kNone;
  for (std::size_t i = 0; i < listed_.size(); ++i) {
    const std::uint32_t p = listed_[i], t = collapse.fan[nearest_[i]].triangle;
    if (p < hangs_.size()) hangs_[p] = 1;
    next_[p] = std::exchange(first_[t], p);
  }
}

}  // namespace meshrepair::internal
