#include <extract/surface.h>

namespace meshrepair {

void keep_triangles(Surface& surface, const std::vector<char>& keep) {
  TriangleSoup& mesh = surface.mesh;
  std::vector<char> is_used(mesh.points.size(), 0);
  std::size_t triangles = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (keep[t] == 0) continue;
    for (const std::uint32_t p : mesh.triangles[t]) is_used[p] = 1;
    mesh.triangles[triangles] = mesh.triangles[t];
    surface.source[triangles++] = surface.source[t];
  }
  mesh.triangles.resize(triangles);
  surface.source.resize(triangles);
  std::vector<std::uint32_t> place(mesh.points.size(), 0);
  std::uint32_t points = 0;
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    if (is_used[p] == 0) continue;
    place[p] = points;
    mesh.points[points] = mesh.points[p];
    surface.input_point[points++] = surface.input_point[p];
  }
  mesh.points.resize(points);
  surface.input_point.resize(points);
  for (auto& t : mesh.triangles) {
    for (std::uint32_t& p : t) p = place[p];
  }
}

}  // namespace meshrepair
