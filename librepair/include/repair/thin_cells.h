// SPDX-License-Identifier: MIT
// Filling slits and dropping fins that are thinner than numbers can tell.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <base/progress.h>
#include <extract/cell_complex.h>
#include <extract/cover_facets.h>

namespace meshrepair {

struct ThinCellsReport {
  std::size_t filled = 0;   // empty cells that became solid
  std::size_t emptied = 0;  // solid cells that became empty
  // By which the boundary became smaller with the one and the other, in grid units, squared;
  // without what only open parts surround, no thicker than rounding.
  double filled_area = 0;
  double emptied_area = 0;
};

struct ThinCellsOptions {
  double within = 0;  // how thin, in grid units
  // Of each triangle, whether it is of a part with open edges: it may go as a whole, and with what
  // is no thicker than rounding and has no other triangles around it, whatever its volume. Empty:
  // none is.
  std::span<const char> open;
  ProgressObserver* progress = nullptr;
};

// Where cutting left faces of the boundary nearer to each other than `within`, the cells between
// them change sides, and the faces go: stacks of cells where many faces nearly coincide,
// together, such that the boundary has the least area. Cells that are wider stay, and so does what
// nothing cuts: of cells that change together, one has a facet of a triangle of which some is no
// boundary. The new boundary is not farther than 2 `within` from the old one. Widths and areas are
// rounded numbers; nothing else depends on them. `solid` has one entry for each cell; it stays as
// it is where a tenth of the volume would go with cells that become empty. Throws Cancelled.
ThinCellsReport relabel_thin_cells(const CellComplex& complex,
                                   const IdVector<FacetId, Cover>& cover,
                                   const ThinCellsOptions& options, std::vector<char>& solid);

}  // namespace meshrepair
