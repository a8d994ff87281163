// SPDX-License-Identifier: MIT
// Slits and fins of a solid that are thinner than its numbers tell.
#pragma once

#include <vector>

#include <repair/repair_options.h>
#include <repair/repair_report.h>

#include "cells/covered_cells.h"

namespace meshrepair::internal {

// How near two sheets may be so that what lies between goes, in grid units: steps of the working
// grid, or so near that they would cross once they are written.
[[nodiscard]] double widest_slit(const CleanSoup& soup, const RepairOptions& options);

// Whether wider ones may be filled and dropped in another attempt.
[[nodiscard]] bool widens_slits(const CoveredCells& covered, const RepairOptions& options);

// Changes `solid`, of each cell, where sheets are nearer to each other than widest_slit(); says so
// in the report.
void fill_slits(const CoveredCells& covered, const RepairOptions& options, std::vector<char>& solid,
                RepairReport& report);

}  // namespace meshrepair::internal
