#include "input_points.h"

namespace meshrepair::internal {

InputPoints::InputPoints(const CleanSoup& soup) : soup_(soup), index_(soup.grid_points.size()) {
  for (PointId p(0u); p < soup.grid_points.end_id(); ++p.value) {
    index_.find_or_insert(hash_of(soup.grid_points[p]), p.value,
                          [](std::uint32_t) { return false; });
  }
}

Vec3d InputPoints::place(const Point& point, const PlaneTable& planes) const {
  if (point.is_lattice()) {
    const GridPoint at = point.lattice();
    const std::uint32_t found = index_.find(hash_of(at), [&](std::uint32_t candidate) {
      return soup_.grid_points[PointId(candidate)] == at;
    });
    if (found != HashIndex::kNone) return soup_.points[PointId(found)];
  }
  return soup_.grid.from_grid(accurate_position(point, planes));
}

}  // namespace meshrepair::internal
