// SPDX-License-Identifier: MIT
#include "fill_slits.h"

#include <algorithm>

#include <mesh/precision.h>
#include <mesh/topology.h>
#include <repair/orient_parts.h>
#include <repair/thin_cells.h>

namespace meshrepair::internal {
namespace {

// In steps of the working grid, to which points of the input were rounded: twice by what that moves
// two sheets towards each other at most, in any direction.
constexpr double kGridSteps = 2;

}  // namespace

double widest_slit(const CleanSoup& soup, const RepairOptions& options) {
  if (options.certify.precision == Precision::float64) return kGridSteps;
  double farthest = 0;
  for (const Vec3d& p : soup.points) farthest = std::max(farthest, p.cwiseAbs().maxCoeff());
  const double spacing = number_spacing(farthest, options.certify.precision);
  return std::max(kGridSteps, options.slit_steps * spacing / soup.grid.unit);
}

bool widens_slits(const CoveredCells& covered, const RepairOptions& options) {
  return options.certify.precision == Precision::float32 && options.slit_steps > 0 &&
         !covered.complex.loose;
}

void fill_slits(const CoveredCells& covered, const RepairOptions& options, std::vector<char>& solid,
                RepairReport& report) {
  report.thin_cells = {};
  report.precision = options.certify.precision;
  report.slits_area = report.fins_area = 0;
  if (options.slit_steps <= 0 || covered.complex.loose) return;
  const CleanSoup& soup = covered.complex.soup();
  ThinCellsOptions thin;
  thin.within = widest_slit(soup, options);
  const std::vector<char> open = triangles_of_open_parts(index_triangles(soup), soup.points.size());
  thin.open = open;
  thin.progress = options.progress;
  report.thin_cells = relabel_thin_cells(covered.complex, covered.cover, thin, solid);
  const double unit = soup.grid.unit;
  report.slits_area = report.thin_cells.filled_area * unit * unit;
  report.fins_area = report.thin_cells.emptied_area * unit * unit;
}

}  // namespace meshrepair::internal
