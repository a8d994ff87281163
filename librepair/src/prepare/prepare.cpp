#include "prepare.h"

#include <algorithm>
#include <cstdint>

#include <base/error.h>
#include <mesh/topology.h>
#include <repair/hole_patches.h>

#include "open/open_sheets.h"

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

}  // namespace

CleanSoup close_soup(const TriangleSoup& soup, const RepairOptions& options, RepairReport& report,
                     StageMeter& meter) {
  meter.begin("clean");
  CleanSoup clean = clean_soup(soup, report.clean, options.progress);
  report.input = examine_topology(index_triangles(clean), clean.points.size());
  report.input_area = 0;
  for (const Triangle& t : clean.triangles) report.input_area += area_of(clean, t);
  report.holes = {};
  if (clean.triangles.empty()) {
    throw NoSolidError(
        "no triangle is left: all are degenerate, or smaller than the working grid of 2^26 steps "
        "over "
        "their bounding box, or have coordinates that are not finite");
  }
  if (report.input.open_edges > 0 || report.input.nonmanifold_edges > 0) {
    meter.begin("holes");
    patch_holes(clean, options.holes, report.holes, options.progress);
  }
  return clean;
}

Orientation orient_soup(const CleanSoup& soup, const RepairOptions& options, RepairReport& report,
                        StageMeter& meter) {
  require_space(soup);
  meter.begin("orient");
  return find_parts(soup, options, report);
}

}  // namespace meshrepair::internal
