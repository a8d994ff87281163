#include <algorithm>
#include <vector>

#include <mesh/mesh_parts.h>
#include <mesh/topology.h>
#include <repair/drop_small_parts.h>
#include <repair/explain_repair.h>

namespace meshrepair {

std::size_t drop_small_parts(Surface& surface, std::size_t fewest, RepairReport& report) {
  const MeshParts parts = find_parts(surface.mesh);
  std::vector<std::size_t> triangles(parts.count, 0);
  for (const std::uint32_t part : parts.of_triangle) ++triangles[part];
  const auto small =
      std::count_if(triangles.begin(), triangles.end(), [&](std::size_t n) { return n < fewest; });
  if (small == 0 || static_cast<std::size_t>(small) == triangles.size()) return 0;
  std::vector<char> keep;
  keep.reserve(parts.of_triangle.size());
  for (const std::uint32_t part : parts.of_triangle) keep.push_back(triangles[part] >= fewest);
  leave_out(surface, keep, report.explanation);
  keep_triangles(surface, keep);
  report.output = examine_topology(surface.mesh.triangles, surface.mesh.points.size());
  report.output_volume = signed_volume(surface.mesh);
  report.output_area = surface_area(surface.mesh);
  return static_cast<std::size_t>(small);
}

}  // namespace meshrepair
