// SPDX-License-Identifier: MIT
#include "strangers.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <base/parallel.h>
#include <base/shared_progress.h>

namespace meshrepair::internal {
namespace {

constexpr std::size_t kCornersPerTask = 2048;

std::vector<Box> boxes_of(const TriangleSoup& soup, const OpenRims& rims) {
  std::vector<Box> boxes(rims.sides.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (const std::uint32_t end : ends_of(rims, rims.sides[i])) boxes[i].add(soup.points[end]);
  }
  return boxes;
}

}  // namespace

NearestOnEdge nearest_on_edge(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
  const Vec3d along = b - a;
  const double length = along.squaredNorm();
  const double share = length > 0 ? std::clamp((p - a).dot(along) / length, 0.0, 1.0) : 0;
  return {(a + share * along - p).squaredNorm(), share};
}

Strangers::Strangers(const TriangleSoup& soup, const OpenRims& rims)
    : soup_(soup), rims_(rims), boxes_(boxes_of(soup, rims)), tree_(boxes_) {}

std::vector<double> distances_of_strangers(const Strangers& strangers, const OpenRims& rims,
                                           double share, ProgressObserver* progress) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::vector<double> distances(rims.corners.size(), kInfinity);
  constexpr std::size_t kCornersPerQuestion = 64;
  SharedProgress shared(progress, 1);
  parallel_tasks(distances.size(), kCornersPerTask,
                 [&](std::size_t, std::size_t first, std::size_t last) {
                   for (std::size_t i = first; i < last; ++i) {
                     if (i % kCornersPerQuestion == 0) shared.poll();
                     double nearest = kInfinity;
                     strangers.visit(rims.corners[i], share * rims.size[rims.corners[i]],
                                     [&](std::uint32_t, const NearestOnEdge& found) {
                                       nearest = std::min(nearest, found.squared_distance);
                                     });
                     distances[i] = std::sqrt(nearest);
                   }
                 });
  return distances;
}

}  // namespace meshrepair::internal
