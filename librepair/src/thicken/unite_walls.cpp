// SPDX-License-Identifier: MIT
#include "unite_walls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include <base/error.h>
#include <mesh/precision.h>
#include <mesh/topology.h>

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
    throw ValueError("walls need a mesh of 1e-90 to 1e90 in size");
  }
  double step = soup.grid.unit;
  if (options.certify.precision == Precision::float32) {
    step = std::max(step, number_spacing(most, Precision::float32));
  }
  const std::string walls = "walls of " + in_words(thickness) + " are ";
  if (thickness < kFewestSteps * step) {
    throw ValueError(walls + "thinner than what the numbers of a mesh of this size tell: from " +
                     in_words(kFewestSteps * step) + " on");
  }
  if (thickness > kMostDiagonals * diagonal) {
    throw ValueError(walls + "far thicker than the mesh is large: up to " +
                     in_words(kMostDiagonals * diagonal));
  }
  return thickness;
}

}  // namespace

RepairOptions options_for_sheets(const RepairOptions& options) {
  const ThickenOptions& thicken = options.thicken;
  if (!std::isfinite(thicken.thickness)) throw UsageError("the thickness of walls is not finite");
  RepairOptions first = options;
  for (double* share : {&first.holes.largest_share, &first.holes.largest_flat_share}) {
    *share = std::min(*share, thicken.largest_hole_share);
  }
  first.holes.sheets_stay_open = std::isfinite(thicken.largest_hole_share);
  return first;
}

SecondSoup add_walls(const CleanSoup& soup, const std::optional<Surface>& solids,
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
  if (solids) report.thicken.solid_volume = report.output_volume;
  SecondSoup walled = solids ? SecondSoup(*solids) : SecondSoup();
  walled.append(walls.soup, walls.source);
  return walled;
}

void finish_walls(const CleanSoup& soup, const SecondSoup& walled, RepairReport united,
                  Surface& surface, RepairReport& report) {
  refer_to_first(walled, surface);
  if (report.thicken.solid_volume == 0) report.inside = united.inside;
  append_report(std::move(united), report);
  report.lost_area = std::max(0.0, report.lost_area - report.thicken.area);
  describe_result(soup, surface, report);
}

double thickness_that_fits(const CleanSoup& soup) {
  const std::vector<std::uint8_t> places(soup.triangles.size(), kOutside);
  return fitting_thickness(soup, find_sheets(soup, places));
}

}  // namespace meshrepair::internal
