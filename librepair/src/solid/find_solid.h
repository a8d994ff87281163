// SPDX-License-Identifier: MIT
// Which cells are solid: by the inside rule, where a cell is closed by itself or stands open.
#pragma once

#include <optional>

#include <base/stage_meter.h>
#include <repair/cell_graph.h>
#include <repair/inside_rule.h>
#include <repair/orient_parts.h>
#include <repair/repair_options.h>
#include <repair/repair_report.h>

#include "cells/covered_cells.h"

namespace meshrepair::internal {

// Some of the parts, as if the others were not there.
struct SomeParts {
  CellGraph graph;
  Orientation orientation;  // says nothing of the others
};

struct ClosedAndOpen {
  SomeParts closed, open;
};

// A part that is closed is solid whatever open sheets there are, and these enclose what they do
// without it: so they may be decided apart. Nothing where all parts are closed, or none is, or
// where the windings contradict each other nowhere, so that there is nothing to doubt; or where a
// closed part faces inward, which may be the wall of a void in what has open edges.
[[nodiscard]] std::optional<ClosedAndOpen> closed_and_open_parts(const CellGraph& graph,
                                                                 const Orientation& orientation,
                                                                 ProgressObserver* progress);

// By the rule that the options name, but for what only open sheets surround, and, where holes are
// not to be closed, for what no triangles seal off. Throws NoSolidError when no cell is solid.
[[nodiscard]] CellLabels find_solid(const CoveredCells& covered, const Orientation& orientation,
                                    const RepairOptions& options, RepairReport& report,
                                    StageMeter& meter);

}  // namespace meshrepair::internal
