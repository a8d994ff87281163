#include "input_points.h"

namespace meshrepair::internal {

InputPoints::InputPoints(const CleanSoup& soup) : soup_(soup), index_(soup.grid_points.size()) {
  for (PointId p(0u); p < soup.grid_points.end_id(); ++p.value) {
    index_.find_or_insert(hash_of(soup.grid_points[p]), p.value, [&](std::uint32_t candidate) {
      return soup.grid_points[PointId(candidate)] == soup.grid_points[p];
    });
  }
}

PointId InputPoints::find(const Point& point) const {
  if (!point.is_lattice()) return {};
  const GridPoint at = point.lattice();
  const std::uint32_t found = index_.find(hash_of(at), [&](std::uint32_t candidate) {
    return soup_.grid_points[PointId(candidate)] == at;
  });
  return found != HashIndex::kNone ? PointId(found) : PointId();
}

}  // namespace meshrepair::internal
