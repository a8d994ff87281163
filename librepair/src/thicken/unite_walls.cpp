#include "unite_walls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <limits>
#include <string>
#include <utility>

#include <base/error.h>
#include <mesh/precision.h>
#include <mesh/topology.h>
#include <mesh/weld_points.h>

#include "find_sheets.h"
#include "report/describe_result.h"

namespace meshrepair::internal {
namespace {

// A wall of more is a solid beside which the sheet is a speck, and takes the steps of the grid from
// all else.
constexpr double kMostDiagonals = 1000;

// Of the working grid, or of the numbers of the format: what is thinner than a few of them is
// filled or dropped, and walls have more than two sides.
constexpr double kFewestSteps = 16;

// Lengths whose cubes are numbers, as normals and angles are found in doubles.
constexpr double kSmallestMesh = 1e-90, kLargestCoordinate = 1e90;

std::string in_words(double x) {
  std::array<char, 32> text{};
  (void)std::snprintf(text.data(), text.size(), "%.3g", x);
  return text.data();
}

double thickness_of(const CleanSoup& soup, const RepairOptions& options) {
  const double diagonal = diagonal_of(soup);
  const ThickenOptions& thicken = options.thicken;
  const double thickness = thicken.is_share ? thicken.thickness * diagonal : thicken.thickness;
  double most = 0;
  for (const Vec3d& p : soup.points) most = std::max(most, p.cwiseAbs().maxCoeff());
  if (diagonal < kSmallestMesh || most > kLargestCoordinate) {
    throw UsageError("walls can be made of meshes of 1e-90 to 1e90 in size, not of this one");
  }
  double step = soup.grid.unit;
  if (options.certify.precision == Precision::float32) {
    step = std::max(step, number_spacing(most, Precision::float32));
  }
  const std::string walls = "walls of " + in_words(thickness) + " are ";
  if (thickness < kFewestSteps * step) {
    throw UsageError(walls + "thinner than what the numbers of a mesh of this size tell: from " +
                     in_words(kFewestSteps * step) + " on");
  }
  if (thickness > kMostDiagonals * diagonal) {
    throw UsageError(walls + "far thicker than the mesh is large: up to " +
                     in_words(kMostDiagonals * diagonal));
  }
  return thickness;
}

void append_walls(SheetWalls walls, WalledSoup& walled) {
  const auto base = static_cast<std::uint32_t>(walled.soup.points.size());
  std::vector<Vec3d>& points = walled.soup.points;
  points.insert(points.end(), walls.soup.points.begin(), walls.soup.points.end());
  for (const auto& [a, b, c] : walls.soup.triangles) {
    walled.soup.triangles.push_back({a + base, b + base, c + base});
  }
  walled.source.insert(walled.source.end(), walls.source.begin(), walls.source.end());
  walled.input_point.resize(points.size(), 0);
}

// On one side of a sheet its own points may be those of the wall, which counts for nothing.
void set_input_points(const WalledSoup& walled, Surface& surface) {
  const std::vector<std::uint32_t> place = first_in_place(walled.soup.points, surface.mesh.points);
  for (std::size_t p = 0; p < place.size(); ++p) {
    const bool is_given = place[p] < walled.input_point.size() && walled.input_point[place[p]] != 0;
    if (!is_given) surface.input_point[p] = 0;
  }
}

}  // namespace

RepairOptions options_for_sheets(const RepairOptions& options) {
  const ThickenOptions& thicken = options.thicken;
  if (!std::isfinite(thicken.thickness)) throw UsageError("the thickness of walls is not finite");
  RepairOptions first = options;
  for (double* share : {&first.holes.largest_share, &first.holes.largest_flat_share}) {
    *share = std::min(*share, thicken.largest_hole_share);
  }
  return first;
}

WalledSoup add_walls(const CleanSoup& soup, const std::optional<Surface>& solids,
                     const RepairOptions& options, RepairReport& report) {
  std::vector<std::uint8_t> places = std::move(report.parts.places);
  if (!solids) places.assign(soup.triangles.size(), kOutside);
  const std::vector<char> is_sheet = find_sheets(soup, places);
  if (std::count(is_sheet.begin(), is_sheet.end(), 1) == 0) return {};
  SheetWalls walls = thicken_sheets(soup, is_sheet, thickness_of(soup, options),
                                    options.thicken.side, report.thicken, options.progress);
  if (walls.soup.triangles.empty()) return {};
  for (std::size_t t = 0; t < places.size(); ++t) {
    if (is_sheet[t] != 0) places[t] = kOnBoundary | kThickened;
  }
  report.parts = find_part_fates(soup, places);
  WalledSoup walled;
  if (solids) {
    walled = {solids->mesh, solids->source, solids->input_point};
    report.thicken.solid_volume = report.output_volume;
  }
  append_walls(std::move(walls), walled);
  return walled;
}

RepairOptions options_for_walls(const WalledSoup& walled, const RepairOptions& options) {
  RepairOptions second = options;
  second.thicken = {};
  second.sew.mode = SewMode::none;
  second.holes.mode = HoleMode::none;
  second.inside.rule = InsideRule::winding;
  second.opacity.clear();
  second.examine = nullptr;
  second.keep_valid = true;
  if (options.reach.empty()) return second;
  second.reach.clear();
  for (const std::uint32_t source : walled.source) {
    second.reach.push_back(source == Surface::kNoSource ? std::numeric_limits<double>::infinity()
                                                        : options.reach[source]);
  }
  return second;
}

void finish_walls(const CleanSoup& soup, const WalledSoup& walled, RepairReport united,
                  Surface& surface, RepairReport& report) {
  for (std::uint32_t& source : surface.source) {
    if (source != Surface::kNoSource) source = walled.source[source];
  }
  set_input_points(walled, surface);
  if (report.thicken.solid_volume == 0) report.inside = united.inside;
  report.kept_valid = false;
  report.spared_cells = false;
  report.predicates = united.predicates;
  report.epsilon = united.epsilon;
  report.extract = united.extract;
  report.thin_cells = united.thin_cells;
  report.precision = united.precision;
  report.slits_area = united.slits_area;
  report.fins_area = united.fins_area;
  report.crumbs += united.crumbs;
  report.simplify = united.simplify;
  report.certify = united.certify;
  report.stages.insert(report.stages.end(), std::make_move_iterator(united.stages.begin()),
                       std::make_move_iterator(united.stages.end()));
  describe_result(soup, surface, report);
}

double thickness_that_fits(const CleanSoup& soup) {
  const std::vector<std::uint8_t> places(soup.triangles.size(), kOutside);
  return fitting_thickness(soup, find_sheets(soup, places));
}

}  // namespace meshrepair::internal
