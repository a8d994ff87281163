// SPDX-License-Identifier: MIT
// The invariants of a cell complex, as code: used by tests and by the debug mode of build_cells().
#pragma once

#include <extract/cell_complex.h>

namespace meshrepair::internal {

// Every loop is closed, simple and linked both ways; every edge of the cell lies between exactly
// two of its facets, which pass it in opposite directions seen from outside; V - E + F = 2; at
// least two facets. Throws InternalError naming what does not hold. Linear in the size of the cell.
void check_cell(const CellComplex& complex, CellId cell);

// All cells, and what ties them together: the ring of uses around every edge is complete, facets
// outside are on the box, cells' lists and facets' sides agree.
void check_complex(const CellComplex& complex);

}  // namespace meshrepair::internal
