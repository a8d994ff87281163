// SPDX-License-Identifier: MIT
#include "keep_valid.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <mesh/weld_points.h>
#include <repair/inside_rule.h>

#include "report/describe_result.h"

namespace meshrepair {
namespace {

void describe_inside(const RepairOptions& options, const std::string& reason,
                     InsideReport& report) {
  report.asked = options.inside.rule;
  const bool any_rule = options.inside.rule == InsideRule::automatic;
  report.used = any_rule ? InsideRule::winding : options.inside.rule;
  report.reason = any_rule ? reason : "asked for";
  report.exact = true;
}

// What a repair would have found.
void describe_as_given(const TriangleSoup& soup, const Surface& surface,
                       const RepairOptions& options, RepairReport& report) {
  const TriangleSoup& mesh = surface.mesh;
  report.kept_valid = true;
  report.clean.triangles_in = soup.triangles.size();
  report.input = report.output = examine_topology(mesh.triangles, mesh.points.size());
  report.input_area = report.output_area = surface_area(mesh);
  report.input_volume = report.output_volume = signed_volume(mesh);
  describe_inside(options, "the mesh is the boundary of a solid", report.inside);
  const auto is_input = [&](std::uint32_t p) { return surface.input_point[p] != 0; };
  for (const auto& t : mesh.triangles) {
    ++(std::all_of(t.begin(), t.end(), is_input) ? report.triangles.untouched
                                                 : report.triangles.cut);
  }
  report.certify.done = true;
}

void describe_mended(const CleanSoup& soup, const MendedSolid& solid, const RepairOptions& options,
                     RepairReport& report) {
  report.spared_cells = true;
  InsideReport& inside = report.inside;
  inside.turned_parts = solid.turned_parts;
  inside.doubtful_parts = report.orient.doubtful_parts;
  inside.cavity_walls = solid.cavity_walls;
  describe_inside(options,
                  "once mended, the mesh is the boundary of a solid" + what_was_turned(inside),
                  inside);
  for (const Triangle& t : soup.triangles) {
    report.parts.bounding_triangles += t.source != Triangle::kNoSource;
  }
  report.certify.done = true;
  internal::describe_result(soup, solid.surface, report);
}

// Whether the rule may fill what is hollow.
bool may_fill(const InsideOptions& options) {
  return options.rule == InsideRule::solidity || options.cavities == Cavities::fill;
}

// Whether cleaning, closing holes and turning triangles has changed nothing.
bool is_as_given(const RepairReport& report) {
  const CleanReport& clean = report.clean;
  return clean.dropped_not_finite + clean.dropped_degenerate + clean.dropped_below_grid +
                 clean.duplicates + clean.opposite_duplicates + clean.joined_points ==
             0 &&
         report.holes.triangles == 0 && report.orient.turned_triangles == 0;
}

}  // namespace

std::optional<Surface> keep_valid(const TriangleSoup& soup, const RepairOptions& options) {
  if (may_fill(options.inside)) return std::nullopt;
  CancelOnly quiet(options.progress);
  return valid_solid(soup, internal::written_as(options), &quiet);
}

namespace internal {

CertifyOptions written_as(const RepairOptions& options) {
  CertifyOptions written = options.certify;
  written.touching = options.extract.touching;
  return written;
}

bool may_spare_cells(const RepairOptions& options) {
  return !options.all_cells && options.predicates == Predicates::exact && !options.check_cells;
}

bool may_be_kept(const RepairOptions& options) {
  return may_spare_cells(options) && options.inside.rule != InsideRule::solidity;
}

bool tells_voids(const Surface& surface, const InsideOptions& options) {
  if (options.cavities == Cavities::keep) return true;
  const std::vector<std::uint32_t> first = first_in_place(surface.mesh.points);
  for (std::size_t p = 0; p < first.size(); ++p) {
    if (first[p] != p) return false;
  }
  return true;
}

std::optional<Surface> keep_as_given(const TriangleSoup& soup, const RepairOptions& options,
                                     RepairReport& report, StageMeter& meter,
                                     std::optional<Invalid>& invalid, NearlySolid& nearly) {
  if (!may_be_kept(options)) return std::nullopt;
  meter.begin("validate");
  CancelOnly quiet(options.progress);
  Invalid why{};
  std::optional<Surface> surface = solid_as_given(soup, written_as(options), &quiet, why, nearly);
  if (!surface) {
    invalid = why;
    return std::nullopt;
  }
  if (!tells_voids(*surface, options.inside)) return std::nullopt;
  meter.begin("check");
  describe_as_given(soup, *surface, options, report);
  if (options.examine) options.examine(report);
  return surface;
}

std::optional<Surface> keep_mended(const CleanSoup& soup, const Orientation& orientation,
                                   std::optional<Invalid> invalid, const RepairOptions& options,
                                   RepairReport& report, StageMeter& meter) {
  if (!may_be_kept(options)) return std::nullopt;
  if (invalid == Invalid::meets_itself && is_as_given(report)) return std::nullopt;
  meter.begin("validate");
  CancelOnly quiet(options.progress);
  std::optional<MendedSolid> solid = mended_solid(soup, orientation, written_as(options), &quiet);
  if (!solid || !tells_voids(solid->surface, options.inside)) return std::nullopt;
  meter.begin("check");
  describe_mended(soup, *solid, options, report);
  if (options.examine) options.examine(report);
  return std::move(solid->surface);
}

}  // namespace internal
}  // namespace meshrepair
