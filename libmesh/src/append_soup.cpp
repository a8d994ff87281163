// SPDX-License-Identifier: MIT
#include <cstdint>

#include <mesh/append_soup.h>
#include <mesh/mesh_limits.h>

namespace meshrepair {

void append_soup(TriangleSoup& all, const TriangleSoup& other, const Placement& placement) {
  require_points(std::uint64_t{all.points.size()} + other.points.size());
  require_triangles(std::uint64_t{all.triangles.size()} + other.triangles.size());
  const auto first = static_cast<std::uint32_t>(all.points.size());
  const bool is_moved = !placement.is_identity(), is_turned = placement.mirrors();
  for (const Vec3d& point : other.points) {
    all.points.push_back(is_moved ? placement.of(point) : point);
  }
  for (const auto& [a, b, c] : other.triangles) {
    all.triangles.push_back({first + a, first + (is_turned ? c : b), first + (is_turned ? b : c)});
  }
}

}  // namespace meshrepair
