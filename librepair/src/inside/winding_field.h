// SPDX-License-Identifier: MIT
// The winding numbers of the cells, by the walk or, where that contradicts itself, by the solver.
#pragma once

#include <vector>

#include <repair/cell_graph.h>
#include <repair/inside_rule.h>

namespace meshrepair::internal {

// 0 outside. Notes in the report whether they are exact, else what the solver did.
[[nodiscard]] std::vector<double> winding_field(const CellGraph& graph, const SolveOptions& options,
                                                InsideReport& report);

}  // namespace meshrepair::internal
