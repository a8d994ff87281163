#include <algorithm>
#include <utility>

#include <mesh/collapsible_mesh.h>
#include <repair/join_ends.h>

namespace meshrepair {
namespace {

// The ends of the edges without length, those that are no points of the input first: they are the
// ones to be moved.
std::vector<std::uint32_t> find_ends(const Surface& surface) {
  const TriangleSoup& mesh = surface.mesh;
  std::vector<std::uint32_t> ends;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      if (mesh.points[a] == mesh.points[b]) ends.insert(ends.end(), {a, b});
    }
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  std::stable_partition(ends.begin(), ends.end(),
                        [&](std::uint32_t p) { return surface.input_point[p] == 0; });
  return ends;
}

}  // namespace

std::size_t join_ends(Surface& surface) {
  const std::vector<std::uint32_t> ends = find_ends(surface);
  if (ends.empty()) return 0;
  const std::vector<Vec3d>& points = surface.mesh.points;
  internal::CollapsibleMesh mesh(surface.mesh.triangles, points.size());
  internal::PointStar star;
  std::size_t joined = 0;
  for (const std::uint32_t p : ends) {
    if (!mesh.find_star(p, star)) continue;
    for (std::size_t i = 0; i < star.link.size(); ++i) {
      if (points[star.link[i]] != points[p] || !mesh.may_collapse(star, i)) continue;
      mesh.collapse(star, i);
      ++joined;
      break;
    }
  }
  if (joined == 0) return 0;
  std::vector<char> is_left;
  is_left.reserve(surface.mesh.triangles.size());
  for (std::uint32_t t = 0; t < surface.mesh.triangles.size(); ++t) {
    is_left.push_back(mesh.is_left(t) ? 1 : 0);
  }
  surface.mesh.triangles = mesh.triangles();
  keep_triangles(surface, is_left);
  return joined;
}

}  // namespace meshrepair
