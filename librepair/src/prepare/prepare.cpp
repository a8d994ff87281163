// SPDX-License-Identifier: MIT
#include "prepare.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include <Eigen/Geometry>

#include <base/error.h>
#include <mesh/topology.h>
#include <repair/hole_patches.h>

#include "open/open_sheets.h"
#include "sew/close_slits.h"
#include "two_layers.h"

namespace meshrepair::internal {
namespace {

Orientation find_parts(const CleanSoup& soup, const RepairOptions& options, RepairReport& report) {
  if (options.inside.rule == InsideRule::automatic) {
    return orient_parts(soup, report.orient, options.progress);
  }
  TopologyPlaces places;
  report.orient.parts = examine_topology(index_triangles(soup), soup.points.size(), &places).parts;
  Orientation as_given;
  as_given.winding = windings_of(soup);
  for (const std::uint32_t part : places.parts) as_given.part_of.push_back(part);
  return as_given;
}

void require_space(const CleanSoup& soup) {
  if (soup.triangles.empty()) return;
  const PlaneId first = soup.triangles[TriangleId(0u)].plane;
  if (std::all_of(soup.triangles.begin(), soup.triangles.end(),
                  [&](const Triangle& t) { return t.plane == first; })) {
    throw NoSolidError("all triangles lie in one plane, so they enclose nothing");
  }
  if (is_flat_sheet(soup)) {
    throw NoSolidError(
        "all triangles lie in one plane, but for the rounding of their coordinates, and leave "
        "edges open, so they enclose nothing");
  }
}

// What is cleaned is the sewn soup, whose triangles have the sources of those that were given.
CleanSoup clean_sewn(const SewnSoup& sewn, const RepairOptions& options, RepairReport& report,
                     StageMeter& meter) {
  meter.begin("clean");
  const std::size_t given = report.clean.triangles_in;
  CleanSoup clean = clean_soup(sewn.soup, report.clean, options.progress);
  report.clean.triangles_in = given;
  for (Triangle& triangle : clean.triangles) triangle.source = sewn.source[triangle.source];
  return clean;
}

// About the middle of the bounding box, so that what is missing counts little.
double volume_of(const CleanSoup& clean) {
  Eigen::AlignedBox3d box;
  for (const Vec3d& point : clean.points) box.extend(point);
  const Vec3d base = box.center();
  double sum = 0;
  for (const Triangle& t : clean.triangles) {
    if (t.winding == 0) continue;  // copies that face both ways
    const Vec3d a = clean.points[t.corners[0]] - base, b = clean.points[t.corners[1]] - base;
    sum += t.layers * a.dot(b.cross(clean.points[t.corners[2]] - base));
  }
  return sum / 6;
}

void measure(const CleanSoup& clean, RepairReport& report) {
  report.input_area = 0;
  for (const Triangle& t : clean.triangles) report.input_area += area_of(clean, t);
  if (!clean.triangles.empty()) report.input_volume = volume_of(clean);
  if (clean.triangles.empty()) {
    throw NoSolidError(
        "no triangle remains: all are degenerate, smaller than the step of the working grid of "
        "2^26 steps over their bounding box, or have coordinates that are not finite");
  }
}

// Copies are there where edges have more than two triangles.
void join_copies(CleanSoup& clean, const Topology& topology, const RepairOptions& options) {
  if (topology.nonmanifold_edges > 0) join_cuts(clean, options.progress);
}

// `now` is the topology of the clean soup.
CleanSoup close_clean(CleanSoup clean, Topology now, const TriangleSoup& soup,
                      const RepairOptions& options, RepairReport& report, StageMeter& meter) {
  report.sew = {};
  join_copies(clean, now, options);
  if (now.open_edges > 0 && options.sew.mode != SewMode::none) {
    meter.begin("sew");
    SewOptions sewing = options.sew;
    sewing.progress = options.progress;
    if (const auto sewn = sew_soup(soup, sewing, report.sew)) {
      clean = clean_sewn(*sewn, options, report, meter);
      now = examine_topology(index_triangles(clean), clean.points.size());
      join_copies(clean, now, options);
    }
  }
  measure(clean, report);
  report.holes = {};
  if (now.open_edges > 0 || now.nonmanifold_edges > 0) {
    meter.begin("holes");
    const std::size_t slits = close_slits(clean, options.progress);
    patch_holes(clean, options.holes, report.holes, options.progress);
    report.holes.loops += slits;
    report.holes.slits += slits;
    join_copies(clean, now, options);
  }
  return clean;
}

}  // namespace

CleanSoup close_soup(const TriangleSoup& soup, const RepairOptions& options, RepairReport& report,
                     StageMeter& meter) {
  meter.begin("clean");
  CleanSoup clean = clean_soup(soup, report.clean, options.progress);
  report.input = examine_topology(index_triangles(clean), clean.points.size());
  const std::optional<TriangleSoup> layered = bring_layers_together(soup, clean, options.progress);
  if (!layered) return close_clean(std::move(clean), report.input, soup, options, report, meter);
  clean = clean_soup(*layered, report.clean, options.progress);
  const Topology now = examine_topology(index_triangles(clean), clean.points.size());
  return close_clean(std::move(clean), now, *layered, options, report, meter);
}

CleanSoup close_surface(const TriangleSoup& mesh, const RepairOptions& options,
                        RepairReport& report, StageMeter& meter) {
  meter.begin("clean");
  CleanSoup clean = clean_surface(mesh, report.clean, options.progress);
  report.input = examine_topology(index_triangles(clean), clean.points.size());
  if (!zip_edges(clean, options.progress)) {
    return close_clean(std::move(clean), report.input, mesh, options, report, meter);
  }
  report.input = examine_topology(index_triangles(clean), clean.points.size());
  report.sew = {};
  report.holes = {};
  measure(clean, report);
  return clean;
}

Orientation orient_soup(const CleanSoup& soup, const RepairOptions& options, RepairReport& report,
                        StageMeter& meter) {
  require_space(soup);
  meter.begin("orient");
  return find_parts(soup, options, report);
}

}  // namespace meshrepair::internal
