// SPDX-License-Identifier: MIT
// What the states of a repair are made of.
//
// fields_of() names all members of a type, or the compiler complains: none is forgotten when one is
// added. RepairReport is without what is found after the last state.
#pragma once

#include <tuple>

#include <bsp/clean_soup.h>
#include <extract/surface.h>
#include <repair/orient_parts.h>
#include <repair/repair_report.h>

#include "state_bytes.h"

// Where the types are, or they would not be found.
namespace meshrepair {

using internal::Is;

template <Is<Grid> T>
auto fields_of(T& grid) {
  auto& [origin, unit] = grid;
  return std::tie(origin, unit);
}

template <Is<CleanSoup> T>
auto fields_of(T& soup) {
  auto& [grid, points, grid_points, triangles, planes] = soup;
  return std::tie(grid, points, grid_points, triangles, planes);
}

template <Is<Orientation> T>
auto fields_of(T& orientation) {
  auto& [winding, part_of, parts] = orientation;
  return std::tie(winding, part_of, parts);
}

template <Is<TriangleSoup> T>
auto fields_of(T& soup) {
  auto& [points, triangles] = soup;
  return std::tie(points, triangles);
}

template <Is<Surface> T>
auto fields_of(T& surface) {
  auto& [mesh, source, input_point] = surface;
  return std::tie(mesh, source, input_point);
}

template <Is<StageReport> T>
auto fields_of(T& stage) {
  auto& [name, seconds, cpu_seconds, peak_bytes] = stage;
  return std::tie(name, seconds, cpu_seconds, peak_bytes);
}

template <Is<PartFates> T>
auto fields_of(T& fates) {
  auto& [nothing, inside, closed_inside, bounding, inside_triangles, outside_triangles, places] =
      fates;
  return std::tie(nothing, inside, closed_inside, bounding, inside_triangles, outside_triangles,
                  places);
}

template <Is<InsideReport> T>
auto fields_of(T& report) {
  auto& [asked, used, reason, exact, contradictions, solve, distance, contradiction, loose, turned,
         doubtful, cavity_walls, poking_walls, poking_share, other, folds, voids, cells] = report;
  return std::tie(asked, used, reason, exact, contradictions, solve, distance, contradiction, loose,
                  turned, doubtful, cavity_walls, poking_walls, poking_share, other, folds, voids,
                  cells);
}

template <Is<RepairReport> T>
auto fields_of(T& report) {
  auto& [kept_valid, spared_cells, clean, input, input_area, input_volume, join_gaps, sew, holes,
         seal, thicken, tree, predicates, epsilon, arrange, cells, facets, clip, cover, orient,
         links, inside, open_regions, parts, lost_area, extract, thin_cells, precision, slits_area,
         fins_area, crumbs, simplify, certify, keep, fewer, triangles, same_triangles, explanation,
         output, output_volume, output_area, closing_area, stages] = report;
  return std::tie(kept_valid, spared_cells, clean, input, input_area, input_volume, sew, holes,
                  seal, thicken, tree, predicates, epsilon, arrange, cells, facets, clip, cover,
                  orient, links, inside, open_regions, parts, lost_area, extract, thin_cells,
                  precision, slits_area, fins_area, crumbs, simplify, certify, triangles,
                  same_triangles, output, output_volume, output_area, closing_area, stages);
}

}  // namespace meshrepair
