#include "whole_triangle.h"

#include <algorithm>

#include <mesh/float32.h>

namespace meshrepair::internal {

bool has_corners_of_source(const TriangleSoup& soup, const Surface& surface, std::size_t t) {
  const auto& from = soup.triangles[surface.source[t]];
  const auto& to = surface.mesh.triangles[t];
  return std::all_of(from.begin(), from.end(), [&](std::uint32_t p) {
    const Vec3d &given = soup.points[p], single = rounded_to_float32(given);
    return std::any_of(to.begin(), to.end(), [&](std::uint32_t q) {
      const Vec3d& point = surface.mesh.points[q];
      return point == given || point == single;
    });
  });
}

}  // namespace meshrepair::internal
