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
  const std::vector<std::uint32_t> first = first_in_place(soup.points);
  std::vector<IndexTriangle> triangles = soup.triangles;
  for (IndexTriangle& t : triangles) {
    for (std::uint32_t& p : t) p = first[p];
  }
  return triangles;
}

bool is_closed_manifold(const Topology& topology) {
  return topology.closed() && topology.manifold() && topology.oriented();
}

// Joins points in one place, if that leaves a closed, oriented manifold.
bool join_points(TriangleSoup& mesh) {
  std::vector<IndexTriangle> joined = welded(mesh);
  if (!is_closed_manifold(examine_topology(joined, mesh.points.size()))) return false;
  mesh.triangles = std::move(joined);
  return true;
}

bool is_manifold_as_it_is(const TriangleSoup& mesh, Touching touching) {
  if (!is_closed_manifold(examine_topology(mesh.triangles, mesh.points.size()))) return false;
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
  if (!join_points(surface.mesh) &&
      (options.welded || !is_manifold_as_it_is(surface.mesh, options.touching))) {
    return std::nullopt;
  }
  if (!bounds_solid(surface.mesh, progress)) return std::nullopt;
  surface.source.resize(surface.mesh.triangles.size());
  std::iota(surface.source.begin(), surface.source.end(), 0u);
  for (std::size_t p = 0; p < soup.points.size(); ++p) {
    surface.input_point.push_back(surface.mesh.points[p] == soup.points[p] ? 1 : 0);
  }
  keep_triangles(surface, std::vector<char>(surface.source.size(), 1));
  return surface;
}

}  // namespace meshrepair
