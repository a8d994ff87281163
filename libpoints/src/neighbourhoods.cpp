#include "neighbourhoods.h"

#include <algorithm>

#include "point_blocks.h"

namespace meshrepair {

Neighbourhoods find_neighbourhoods(const PointIndex& index, const std::vector<Vec3d>& points,
                                   std::size_t count, ProgressObserver* progress) {
  Neighbourhoods result;
  if (points.empty()) return result;
  result.per_point = std::min(count, points.size() - 1);
  result.points.resize(points.size() * result.per_point);
  for_blocks(points.size(), progress, [&](std::size_t, std::size_t first, std::size_t last) {
    std::vector<Neighbour> found(result.per_point + 1);
    for (std::size_t i = first; i < last; ++i) {
      const std::uint32_t p = index.order()[i];
      index.nearest(points[p], found);
      // Where points coincide, the point itself need not be among those that were found.
      std::uint32_t* out = result.points.data() + std::size_t{p} * result.per_point;
      std::uint32_t* const end = out + result.per_point;
      for (const Neighbour& neighbour : found) {
        if (neighbour.point != p && out != end) *out++ = neighbour.point;
      }
    }
  });
  return result;
}

}  // namespace meshrepair
