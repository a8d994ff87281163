// SPDX-License-Identifier: MIT
// The chambers of an arrangement as the cells that inside rules look at.
#pragma once

#include <extract/arrange.h>
#include <repair/cell_graph.h>
#include <repair/orient_parts.h>

namespace meshrepair {

// Walls between the same chambers that say the same are one link.
[[nodiscard]] CellGraph graph_of_chambers(const Arrangement& arrangement, const CleanSoup& soup,
                                          const Orientation& orientation);

}  // namespace meshrepair
