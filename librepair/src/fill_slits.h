// Slits and fins of a solid that a format cannot hold.
#pragma once

#include <span>
#include <vector>

#include <repair/repair.h>

#include "covered_cells.h"

namespace meshrepair::internal {

// Whether any are to be filled and dropped.
[[nodiscard]] bool fills_slits(const CoveredCells& covered, const RepairOptions& options);

// Changes `solid`, of each cell, where sheets would cross once they are written, as they are so
// near to each other; says so in the report. `states` as relabel_thin_cells() has it.
void fill_slits(const CoveredCells& covered, const RepairOptions& options,
                std::span<const CellState> states, std::vector<char>& solid, RepairReport& report);

}  // namespace meshrepair::internal
