// SPDX-License-Identifier: MIT
#include <base/ids.h>
#include <extract/surface.h>
#include <mesh/append_soup.h>

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

std::vector<Surface> divide_surface(const Surface& surface, const MeshParts& groups) {
  std::vector<Surface> divided(groups.count);
  const TriangleSoup& mesh = surface.mesh;
  std::vector<std::uint32_t> group_of(mesh.points.size(), kNoGroup), place(mesh.points.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t p : mesh.triangles[t]) group_of[p] = groups.of_triangle[t];
  }
  for (std::size_t p = 0; p < place.size(); ++p) {
    if (group_of[p] == kNoGroup) continue;
    Surface& group = divided[group_of[p]];
    place[p] = static_cast<std::uint32_t>(group.mesh.points.size());
    group.mesh.points.push_back(mesh.points[p]);
    group.input_point.push_back(surface.input_point[p]);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (groups.of_triangle[t] == kNoGroup) continue;
    const auto& [a, b, c] = mesh.triangles[t];
    Surface& group = divided[groups.of_triangle[t]];
    group.mesh.triangles.push_back({place[a], place[b], place[c]});
    group.source.push_back(surface.source[t]);
  }
  return divided;
}

void append_surface(Surface& all, const Surface& other) {
  append_soup(all.mesh, other.mesh);
  all.source.insert(all.source.end(), other.source.begin(), other.source.end());
  all.input_point.insert(all.input_point.end(), other.input_point.begin(), other.input_point.end());
}

}  // namespace meshrepair
