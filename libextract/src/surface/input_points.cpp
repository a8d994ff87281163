// SPDX-License-Identifier: MIT
#include "input_points.h"

#include <cmath>
#include <cstdint>

#include <exact/internal/grid_hash.h>

namespace meshrepair::internal {

InputPoints::InputPoints(const CleanSoup& soup) : soup_(soup), index_(soup.grid_points.size()) {
  for (PointId p(0u); p < soup.grid_points.end_id(); ++p.value) {
    index_.find_or_insert(hash_of(soup.grid_points[p]), p.value, [&](std::uint32_t candidate) {
      return soup.grid_points[PointId(candidate)] == soup.grid_points[p];
    });
  }
}

PointId InputPoints::find(const Point& point) const {
  const std::optional<GridPoint> at = lattice_of(point);
  if (!at) return {};
  const std::uint32_t found = index_.find(hash_of(*at), [&](std::uint32_t candidate) {
    return soup_.grid_points[PointId(candidate)] == *at;
  });
  return found != HashIndex::kNone ? PointId(found) : PointId();
}

std::optional<GridPoint> InputPoints::lattice_of(const Point& point) {
  if (point.is_lattice()) return point.lattice();
  if (!point.is_loose()) return std::nullopt;
  const auto rounded = [](double x) { return static_cast<std::int32_t>(std::nearbyint(x)); };
  return GridPoint{rounded(point.position[0]), rounded(point.position[1]),
                   rounded(point.position[2])};
}

}  // namespace meshrepair::internal
