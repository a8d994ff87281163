// SPDX-License-Identifier: MIT
#include "page/joined_check.h"

#include <cmath>
#include <utility>

#include <base/roots.h>

#include "page/mesh_facts.h"

namespace meshrepair {
namespace {

bool has_points(Defect defect) {
  return defect == Defect::open_edge || defect == Defect::nonmanifold_edge ||
         defect == Defect::inconsistent_edge || defect == Defect::nonmanifold_vertex ||
         defect == Defect::unused_point;
}

void append_places(Defect defect, DefectPlaces places, const SurfaceCheck& before,
                   DefectPlaces& all) {
  const std::size_t offset = has_points(defect) ? before.points : before.triangles;
  all.count += places.count;
  for (Place& place : places.first) {
    if (all.first.size() == kMostPagePlaces) return;
    for (std::uint32_t& id : place.ids) id += static_cast<std::uint32_t>(offset);
    all.first.push_back(place);
  }
}

}  // namespace

// As of one mesh whose parts have nothing to do with each other.
void append_check(SurfaceCheck check, SurfaceCheck& all) {
  for (std::size_t d = 0; d < kDefects; ++d) {
    append_places(static_cast<Defect>(d), std::move(check.defects[d]), all, all.defects[d]);
  }
  for (SurfacePart& part : check.parts) {
    part.first_triangle += static_cast<std::uint32_t>(all.triangles);
    all.parts.push_back(part);
  }
  all.self_intersections.count += check.self_intersections.count;
  all.self_intersections.crossing += check.self_intersections.crossing;
  all.self_intersections.touching += check.self_intersections.touching;
  all.self_intersections.coplanar += check.self_intersections.coplanar;
  all.self_intersections.degenerate += check.self_intersections.degenerate;
  all.self_intersections.not_finite += check.self_intersections.not_finite;
  all.points += check.points;
  all.triangles += check.triangles;
  all.edges += check.edges;
  all.cavities += check.cavities;
  all.volume += check.volume;
  all.area += check.area;
  all.marks.insert(all.marks.end(), check.marks.begin(), check.marks.end());
}

SurfaceCheck placed_check(SurfaceCheck check, const Placement& placement) {
  const double volume = std::abs(placement.linear.determinant());
  const double area = cube_root(volume) * cube_root(volume);
  for (DefectPlaces& places : check.defects) {
    for (Place& place : places.first) place.at = placement.of(place.at);
  }
  for (SurfacePart& part : check.parts) {
    part.volume *= volume;
    part.area *= area;
  }
  check.volume *= volume;
  check.area *= area;
  return check;
}

}  // namespace meshrepair
