// SPDX-License-Identifier: MIT
// Parts that are inside out, and parts that do not tell which way is out: geometry decides.
#pragma once

#include <cstddef>
#include <vector>

#include <repair/cell_graph.h>
#include <repair/inside_rule.h>
#include <repair/orient_parts.h>

namespace meshrepair::internal {

// The winding numbers with every part turned as it must be. `w` are those of the graph, where the
// parts are turned as `orientation` says; they come back as they are when there is nothing to
// doubt. Counts in the report what was turned.
[[nodiscard]] std::vector<double> turn_parts(const CellGraph& graph, const Orientation& orientation,
                                             std::vector<double> w, const InsideOptions& options,
                                             InsideReport& report);

}  // namespace meshrepair::internal
