#include "drop_turned_parts.h"

#include <array>
#include <cstdint>

#include <Eigen/Geometry>

#include <bsp/disjoint_sets.h>

namespace meshrepair::internal {
namespace {

constexpr std::uint32_t kNone = ~std::uint32_t{0};

// Six times the signed volume of each part, relative to one of its own points, so that small parts
// far from the origin keep their digits. Indexed by the part's root.
std::vector<double> volumes(const TriangleSoup& mesh, const std::vector<Vec3d>& points,
                            const std::vector<std::uint32_t>& part) {
  std::vector<double> volume(points.size(), 0);
  for (const auto& t : mesh.triangles) {
    const std::uint32_t root = part[t[0]];
    const Vec3d a = points[t[0]] - points[root];
    const Vec3d b = points[t[1]] - points[root];
    const Vec3d c = points[t[2]] - points[root];
    volume[root] += a.dot(b.cross(c));
  }
  return volume;
}

void remove_parts(Surface& surface, const std::vector<std::uint32_t>& part,
                  const std::vector<char>& drop) {
  TriangleSoup& mesh = surface.mesh;
  std::size_t kept = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (drop[part[mesh.triangles[t][0]]] != 0) continue;
    mesh.triangles[kept] = mesh.triangles[t];
    surface.source[kept++] = surface.source[t];
  }
  mesh.triangles.resize(kept);
  surface.source.resize(kept);
  std::vector<std::uint32_t> place(mesh.points.size(), kNone);
  std::uint32_t points = 0;
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    if (drop[part[p]] != 0) continue;
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

}  // namespace

std::size_t drop_turned_parts(Surface& surface, const std::vector<Vec3d>& before) {
  const TriangleSoup& mesh = surface.mesh;
  DisjointSets joined(mesh.points.size());
  for (const auto& t : mesh.triangles) {
    joined.join(t[0], t[1]);
    joined.join(t[0], t[2]);
  }
  std::vector<std::uint32_t> part(mesh.points.size());
  for (std::uint32_t p = 0; p < part.size(); ++p) part[p] = joined.root(p);
  const std::vector<double> was = volumes(mesh, before, part);
  const std::vector<double> is = volumes(mesh, mesh.points, part);
  std::vector<char> drop(mesh.points.size(), 0);
  std::size_t dropped = 0;
  std::size_t parts = 0;
  for (std::size_t p = 0; p < part.size(); ++p) {
    if (part[p] != p) continue;
    ++parts;
    if ((was[p] > 0 && is[p] > 0) || (was[p] < 0 && is[p] < 0)) continue;
    drop[p] = 1;
    ++dropped;
  }
  if (dropped == 0 || dropped == parts) return 0;
  remove_parts(surface, part, drop);
  return dropped;
}

}  // namespace meshrepair::internal
