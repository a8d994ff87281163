// SPDX-License-Identifier: MIT
#include "new_points.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <base/first_known.h>
#include <exact/internal/grid_hash.h>

namespace meshrepair::internal {
namespace {

std::int32_t nearest_step(double x) {
  constexpr double kRadius = kGridRadius;
  return static_cast<std::int32_t>(std::clamp(std::nearbyint(x), -kRadius, kRadius));
}

// The points of a soup, and behind them those that may be new.
struct PointKeys {
  const IdVector<PointId, GridPoint>& known;
  const std::vector<GridPoint>& fresh;

  [[nodiscard]] const GridPoint& at(std::uint32_t i) const {
    return i < known.size() ? known[PointId(i)] : fresh[i - known.size()];
  }
  [[nodiscard]] std::uint64_t hash_of(std::uint32_t i) const { return internal::hash_of(at(i)); }
  [[nodiscard]] bool same(std::uint32_t i, std::uint32_t j) const { return at(i) == at(j); }
};

}  // namespace

std::vector<PointId> add_points(CleanSoup& soup, const std::vector<Vec3d>& places) {
  std::vector<GridPoint> fresh;
  fresh.reserve(places.size());
  for (const Vec3d& at : places) {
    fresh.push_back({nearest_step(at.x()), nearest_step(at.y()), nearest_step(at.z())});
  }
  const auto known = static_cast<std::uint32_t>(soup.grid_points.size());
  const std::vector<std::uint32_t> first = first_known(
      known, static_cast<std::uint32_t>(fresh.size()), PointKeys{soup.grid_points, fresh});
  const std::size_t all = known + count_fresh(first, known);
  soup.grid_points.reserve(all);
  soup.points.reserve(all);
  std::vector<PointId> ids(fresh.size());
  for (std::uint32_t i = 0; i < ids.size(); ++i) {
    if (first[i] != known + i) {
      ids[i] = first[i] < known ? PointId(first[i]) : ids[first[i] - known];
      continue;
    }
    const Vec3d position = as_vector(fresh[i]);
    ids[i] = soup.grid_points.push_back(fresh[i]);
    soup.points.push_back(soup.grid.from_grid({position.x(), position.y(), position.z()}));
  }
  return ids;
}

}  // namespace meshrepair::internal
