#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include <bsp/topology.h>
#include <bsp/weld_points.h>
#include <extract/edge_contacts.h>
#include <extract/part_orientation.h>
#include <extract/self_intersections.h>
#include <repair/valid_solid.h>

#include "number_spacing.h"

namespace meshrepair {
namespace {

bool has_indices_in_range(const TriangleSoup& soup) {
  return std::all_of(soup.triangles.begin(), soup.triangles.end(), [&](const IndexTriangle& t) {
    return std::all_of(t.begin(), t.end(), [&](std::uint32_t p) { return p < soup.points.size(); });
  });
}

TriangleSoup as_written(TriangleSoup soup, Precision precision) {
  for (Vec3d& p : soup.points) p = internal::rounded_to(p, precision);
  return soup;
}

// The triangles with the first of all points that lie in one place.
std::vector<IndexTriangle> welded(const TriangleSoup& soup) {
  const std::vector<std::uint32_t> place = find_places(soup.points).place;
  std::vector<std::uint32_t> first(soup.points.size());
  for (auto p = static_cast<std::uint32_t>(first.size()); p-- > 0;) first[place[p]] = p;
  std::vector<IndexTriangle> triangles = soup.triangles;
  for (IndexTriangle& t : triangles) {
    for (std::uint32_t& p : t) p = first[place[p]];
  }
  return triangles;
}

bool is_closed_manifold(const Topology& topology) {
  return topology.closed() && topology.manifold() && topology.oriented();
}

// Whether the surface is a closed, oriented manifold, with points joined where that makes it one.
bool make_manifold(TriangleSoup& mesh, bool points_may_be_apart) {
  std::vector<IndexTriangle> joined = welded(mesh);
  if (is_closed_manifold(examine_topology(joined, mesh.points.size()))) {
    mesh.triangles = std::move(joined);
    return true;
  }
  return points_may_be_apart &&
         is_closed_manifold(examine_topology(mesh.triangles, mesh.points.size()));
}

bool touches_as_asked(const TriangleSoup& mesh, Touching touching) {
  const EdgeContacts contacts = examine_edge_contacts(mesh);
  return touching == Touching::separate ? contacts.separate : contacts.joined;
}

bool bounds_solid(const TriangleSoup& mesh, ProgressObserver* progress) {
  SelfIntersectionOptions options;
  options.most_pairs = 0;
  options.progress = progress;
  const SelfIntersections found = self_intersections(mesh, options);
  if (found.count + found.degenerate + found.not_finite > 0) return false;
  const std::vector<char> turned = examine_part_orientation(mesh, progress).inside_out;
  return std::none_of(turned.begin(), turned.end(), [](char is_turned) { return is_turned != 0; });
}

}  // namespace

std::optional<Surface> valid_solid(const TriangleSoup& soup, const CertifyOptions& options,
                                   ProgressObserver* progress) {
  if (soup.triangles.empty() || !has_indices_in_range(soup)) return std::nullopt;
  Surface surface;
  surface.mesh = as_written(soup, options.precision);
  if (!make_manifold(surface.mesh, !options.welded)) return std::nullopt;
  if (!bounds_solid(surface.mesh, progress)) return std::nullopt;
  if (!touches_as_asked(surface.mesh, options.touching)) return std::nullopt;
  surface.source.resize(surface.mesh.triangles.size());
  std::iota(surface.source.begin(), surface.source.end(), 0u);
  for (std::size_t p = 0; p < soup.points.size(); ++p) {
    surface.input_point.push_back(surface.mesh.points[p] == soup.points[p] ? 1 : 0);
  }
  keep_triangles(surface, std::vector<char>(surface.source.size(), 1));
  return surface;
}

}  // namespace meshrepair
