#include "near_mesh.h"

#include <algorithm>
#include <utility>

#include <base/ids.h>
#include <mesh/weld_points.h>

namespace meshrepair::internal {

double share_along(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
  const Vec3d way = b - a;
  const double squared = way.squaredNorm();
  return squared > 0 ? way.dot(p - a) / squared : 0;
}

NearMesh::NearMesh(const TriangleSoup& soup)
    : at(soup.points), name(first_in_place(soup.points)), inner(soup.triangles.size()) {
  corners.reserve(soup.triangles.size());
  for (const auto& t : soup.triangles) corners.push_back({name[t[0]], name[t[1]], name[t[2]]});
}

std::vector<std::uint32_t> NearMesh::along(std::uint32_t from, std::uint32_t to) const {
  std::vector<std::uint32_t> points = {from};
  const std::uint32_t e = edge_between(from, to);
  if (e == kNone) return points;
  const Edge& edge = edges[e];
  std::vector<std::pair<double, std::uint32_t>> order;
  for (const std::uint32_t p : edge.inner) {
    order.emplace_back(share_along(at[p], at[edge.ends[0]], at[edge.ends[1]]), p);
  }
  std::sort(order.begin(), order.end());
  if (from != edge.ends[0]) std::reverse(order.begin(), order.end());
  for (const auto& [share, p] : order) points.push_back(p);
  return points;
}

std::uint32_t NearMesh::edge_between(std::uint32_t a, std::uint32_t b) const {
  const EdgeEnds ends = ascending(a, b);
  const auto found = std::lower_bound(edges.begin(), edges.end(), ends,
                                      [](const Edge& e, const EdgeEnds& x) { return e.ends < x; });
  return found != edges.end() && found->ends == ends
             ? static_cast<std::uint32_t>(found - edges.begin())
             : kNone;
}

}  // namespace meshrepair::internal
