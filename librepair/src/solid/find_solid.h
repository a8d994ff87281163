// Which cells are solid.
#pragma once

#include <base/stage_meter.h>
#include <repair/inside_rule.h>
#include <repair/orient_parts.h>
#include <repair/repair_options.h>
#include <repair/repair_report.h>

#include "cells/covered_cells.h"

namespace meshrepair::internal {

// By the rule that the options name, but for what only open sheets surround, and, where holes are
// not to be closed, for what no triangles seal off. Throws NoSolidError when no cell is solid.
[[nodiscard]] CellLabels find_solid(const CoveredCells& covered, const Orientation& orientation,
                                    const RepairOptions& options, RepairReport& report,
                                    StageMeter& meter);

}  // namespace meshrepair::internal
