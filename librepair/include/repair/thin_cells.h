// Filling slits and dropping fins that are thinner than what a file can hold.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <bsp/progress.h>
#include <extract/cell_complex.h>
#include <extract/cover_facets.h>

namespace meshrepair {

struct ThinCellsReport {
  std::size_t filled = 0;   // empty cells that became solid
  std::size_t emptied = 0;  // solid cells that became empty
  // By which the boundary became smaller with the one and the other, in grid units, squared.
  double filled_area = 0;
  double emptied_area = 0;
  // A cell that had to stay would have changed.
  bool reaches_fixed = false;
};

// What may become of a cell.
enum class CellState : char {
  free,
  fixed,    // stays as it is
  unknown,  // stays, and nobody knows whether it is solid; it has no facet in common with a free
            // one
};

// Where cutting left two sheets of the boundary nearer to each other than `within`, in grid units,
// what lies between them changes sides, and both go. Cells do so one by one, each at most once, if
// that makes the boundary clearly smaller, if all of one of their broad sides is boundary, and if
// on one of them lies no triangle that is boundary as a whole: what nothing cuts stays as it is. So
// the new boundary is not farther than `within` from the old one. Widths are rounded numbers;
// nothing else depends on them. `states` has the state of each cell; empty: all are free. `solid`
// has one entry for each cell; it stays as it is where a tenth of the volume would go with cells
// that become empty. Linear in the complex. Throws Cancelled.
ThinCellsReport relabel_thin_cells(const CellComplex& complex,
                                   const IdVector<FacetId, Cover>& cover, double within,
                                   std::vector<char>& solid, ProgressObserver* progress = nullptr,
                                   std::span<const CellState> states = {});

}  // namespace meshrepair
