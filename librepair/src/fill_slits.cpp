#include "fill_slits.h"

#include <algorithm>

#include <repair/thin_cells.h>

#include "number_spacing.h"

namespace meshrepair::internal {

bool fills_slits(const CoveredCells& covered, const RepairOptions& options) {
  return options.certify.precision == Precision::float32 && options.slit_steps > 0 &&
         !covered.complex.loose;
}

void fill_slits(const CoveredCells& covered, const RepairOptions& options,
                std::span<const CellState> states, std::vector<char>& solid, RepairReport& report) {
  report.thin_cells = {};
  report.slits_area = report.fins_area = 0;
  if (!fills_slits(covered, options)) return;
  const CleanSoup& soup = covered.complex.soup();
  double farthest = 0;
  for (const Vec3d& p : soup.points) farthest = std::max(farthest, p.cwiseAbs().maxCoeff());
  const double spacing = number_spacing(farthest, options.certify.precision);
  const double unit = soup.grid.unit;
  report.thin_cells =
      relabel_thin_cells(covered.complex, covered.cover, options.slit_steps * spacing / unit, solid,
                         options.progress, states);
  report.slits_area = report.thin_cells.filled_area * unit * unit;
  report.fins_area = report.thin_cells.emptied_area * unit * unit;
}

}  // namespace meshrepair::internal
