#include "new_points.h"

#include <algorithm>
#include <cmath>

#include <exact/grid_hash.h>

namespace meshrepair::internal {
namespace {

std::int32_t nearest_step(double x) {
  constexpr double kReach = kGridRadius;
  return static_cast<std::int32_t>(std::clamp(std::nearbyint(x), -kReach, kReach));
}

}  // namespace

void NewPoints::index_all() {
  index_.emplace(2 * soup_.grid_points.size());
  for (PointId p(0u); p < soup_.grid_points.end_id(); ++p.value) {
    (void)index_->find_or_insert(hash_of(soup_.grid_points[p]), p.value,
                                 [](std::uint32_t) { return false; });
  }
}

PointId NewPoints::add(const Vec3d& at) {
  if (!index_) index_all();
  const GridPoint place{nearest_step(at.x()), nearest_step(at.y()), nearest_step(at.z())};
  const auto count = static_cast<std::uint32_t>(soup_.grid_points.size());
  if (index_->full(count)) {
    index_->grow(count, [&](std::uint32_t p) { return hash_of(soup_.grid_points[PointId(p)]); });
  }
  const PointId id(index_->find_or_insert(hash_of(place), count, [&](std::uint32_t p) {
    return soup_.grid_points[PointId(p)] == place;
  }));
  if (id.value == count) {
    const Vec3d position = as_vector(place);
    soup_.grid_points.push_back(place);
    soup_.points.push_back(soup_.grid.from_grid({position.x(), position.y(), position.z()}));
  }
  return id;
}

}  // namespace meshrepair::internal
