// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <utility>
#include <vector>

#include <check/edge_contacts.h>
#include <check/part_orientation.h>
#include <check/self_intersections.h>
#include <mesh/internal/triangle_measures.h>
#include <mesh/mesh_parts.h>
#include <mesh/precision.h>
#include <mesh/topology.h>
#include <mesh/weld_points.h>
#include <repair/valid_solid.h>

#include "nearly_solid.h"
#include "orient/surface_pieces.h"

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

// Some of them, if there are any.
SelfIntersections find_faults(const TriangleSoup& mesh, ProgressObserver* progress) {
  SelfIntersectionOptions options;
  options.enough = 0;
  options.progress = progress;
  return self_intersections(mesh, options);
}

// Its triangles and points are those of the soup, in their order.
void name_sources(const TriangleSoup& soup, Surface& surface) {
  surface.source.resize(surface.mesh.triangles.size());
  std::iota(surface.source.begin(), surface.source.end(), 0u);
  for (std::size_t p = 0; p < soup.points.size(); ++p) {
    surface.input_point.push_back(surface.mesh.points[p] == soup.points[p] ? 1 : 0);
  }
}

// The soup as it will be written, if that is all that valid_solid() asks for, but for the way its
// parts face.
std::optional<Surface> sound_surface(const TriangleSoup& soup, const CertifyOptions& options,
                                     ProgressObserver* progress, Invalid& why,
                                     internal::NearlySolid* nearly = nullptr) {
  why = Invalid::not_manifold;
  if (soup.triangles.empty() || !has_indices_in_range(soup)) return std::nullopt;
  Surface surface;
  surface.mesh = as_written(soup, options.precision);
  const bool is_joined = join_points(surface.mesh);
  if (!is_joined && (options.welded || !is_manifold_as_it_is(surface.mesh, options.touching))) {
    return std::nullopt;
  }
  why = Invalid::meets_itself;
  const SelfIntersections found = find_faults(surface.mesh, progress);
  name_sources(soup, surface);
  if (found.count + found.degenerate + found.not_finite > 0) {
    if (nearly != nullptr && is_joined) *nearly = {std::move(surface), found};
    return std::nullopt;
  }
  keep_triangles(surface, std::vector<char>(surface.source.size(), 1));
  return surface;
}

bool any(const std::vector<char>& flags) {
  return std::any_of(flags.begin(), flags.end(), [](char flag) { return flag != 0; });
}

// Triangle by triangle. None where one is turned both ways, or part of several surfaces.
std::optional<TriangleSoup> oriented(const CleanSoup& soup, const Orientation& orientation) {
  TriangleSoup mesh;
  mesh.points.assign(soup.points.begin(), soup.points.end());
  mesh.triangles = index_triangles(soup);
  for (TriangleId t(0u); t < soup.triangles.end_id(); ++t.value) {
    const std::int32_t winding = orientation.winding[t];
    if (std::abs(winding) != 1) return std::nullopt;
    IndexTriangle& corners = mesh.triangles[t.index()];
    if (winding != internal::side_of_corners(soup, t)) std::swap(corners[1], corners[2]);
  }
  return mesh;
}

// Of each part of the surface, whether its triangles tell which way is out. The surface has all
// triangles of the soup, in their order.
std::vector<char> parts_that_tell(const PartOrientation& found, const Orientation& orientation) {
  std::vector<char> tells(found.inside_out.size(), 1);
  if (orientation.parts.empty()) return tells;
  for (TriangleId t(0u); t < orientation.part_of.end_id(); ++t.value) {
    if (!orientation.parts[orientation.part_of[t]].believed) tells[found.part_of[t.index()]] = 0;
  }
  return tells;
}

// Whether all that are inside out may be turned: see turn_parts().
bool may_turn(const PartOrientation& found, const std::vector<char>& tells) {
  const auto& wrong = found.inside_out;
  bool any_told_wrong = false, all_told_wrong = true;
  for (std::size_t part = 0; part < wrong.size(); ++part) {
    const bool told_wrong = wrong[part] != 0 && tells[part] != 0;
    any_told_wrong |= told_wrong;
    all_told_wrong &= told_wrong;
  }
  const bool any_nested =
      std::any_of(found.depth.begin(), found.depth.end(), [](std::uint32_t d) { return d > 0; });
  return !any_told_wrong || all_told_wrong || !any_nested;
}

// Whether a part that does not tell its way out lies in one of which holes make up most:
// turn_parts() decides what it is.
bool is_wall_in_made_up(const CleanSoup& soup, const TriangleSoup& mesh,
                        const PartOrientation& found, const std::vector<char>& tells) {
  std::vector<double> area(tells.size(), 0), made_up(tells.size(), 0);
  bool any_wall = false, any_made_up = false;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const IndexTriangle& corners = mesh.triangles[t];
    const double size = internal::triangle_area(mesh.points[corners[0]], mesh.points[corners[1]],
                                                mesh.points[corners[2]]);
    area[found.part_of[t]] += size;
    if (soup.triangles[TriangleId(t)].source == Triangle::kNoSource) {
      made_up[found.part_of[t]] += size;
    }
  }
  for (std::size_t part = 0; part < tells.size(); ++part) {
    any_wall |= found.depth[part] % 2 != 0 && tells[part] == 0;
    any_made_up |= found.depth[part] % 2 == 0 && 2 * made_up[part] > area[part];
  }
  return any_wall && any_made_up;
}

// Thinner, on average, than a step of the grid: it is nothing to the rest of a repair.
bool any_part_is_thin(const TriangleSoup& mesh, const PartOrientation& found, double step) {
  const UnitScale scale(mesh.points);
  const std::vector<PartSize> sizes =
      part_sizes(mesh.points, mesh.triangles, found.part_of,
                 static_cast<std::uint32_t>(found.inside_out.size()), scale);
  return std::any_of(sizes.begin(), sizes.end(), [&](const PartSize& size) {
    return 2 * std::abs(size.volume) < scale(step) * size.area;
  });
}

}  // namespace

namespace internal {

std::optional<Surface> solid_as_given(const TriangleSoup& soup, const CertifyOptions& options,
                                      ProgressObserver* progress, Invalid& why,
                                      NearlySolid& nearly) {
  std::optional<Surface> surface = sound_surface(soup, options, progress, why, &nearly);
  if (surface && any(examine_part_orientation(surface->mesh, progress).inside_out)) {
    surface.reset();
    why = Invalid::faces_the_wrong_way;
  }
  return surface;
}

bool is_manifold_as_asked(const TriangleSoup& mesh, const CertifyOptions& options) {
  if (is_closed_manifold(examine_topology(welded(mesh), mesh.points.size()))) return true;
  return !options.welded && is_manifold_as_it_is(mesh, options.touching);
}

}  // namespace internal

std::optional<Surface> valid_solid(const TriangleSoup& soup, const CertifyOptions& options,
                                   ProgressObserver* progress, Invalid* why) {
  Invalid found{};
  internal::NearlySolid nearly;
  std::optional<Surface> surface = internal::solid_as_given(soup, options, progress, found, nearly);
  if (!surface && why != nullptr) *why = found;
  return surface;
}

std::optional<MendedSolid> mended_solid(const CleanSoup& soup, const Orientation& orientation,
                                        const CertifyOptions& options, ProgressObserver* progress) {
  const std::optional<TriangleSoup> mesh = oriented(soup, orientation);
  Invalid why{};
  std::optional<Surface> surface =
      mesh ? sound_surface(*mesh, options, progress, why) : std::nullopt;
  if (!surface) return std::nullopt;
  const PartOrientation found = examine_part_orientation(surface->mesh, progress);
  const std::vector<char> tells = parts_that_tell(found, orientation);
  const bool turns_any = any(found.inside_out);
  if (turns_any && (orientation.parts.empty() || !may_turn(found, tells))) return std::nullopt;
  if (is_wall_in_made_up(soup, surface->mesh, found, tells)) return std::nullopt;
  if (any_part_is_thin(surface->mesh, found, soup.grid.unit)) return std::nullopt;
  MendedSolid solid{std::move(*surface)};
  for (std::size_t part = 0; part < tells.size(); ++part) {
    solid.turned_parts += found.inside_out[part] != 0 && tells[part] != 0;
    solid.cavity_walls += found.depth[part] % 2 != 0 && tells[part] == 0;
  }
  for (std::size_t t = 0; t < solid.surface.source.size(); ++t) {
    IndexTriangle& corners = solid.surface.mesh.triangles[t];
    if (found.inside_out[found.part_of[t]] != 0) std::swap(corners[1], corners[2]);
    solid.surface.source[t] = soup.triangles[TriangleId(t)].source;
  }
  return solid;
}

}  // namespace meshrepair
