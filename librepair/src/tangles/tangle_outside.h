// Which of the cells around tangles lie outside of everything?
#pragma once

#include <span>

#include <base/progress.h>
#include <repair/cell_graph.h>

#include "tangle_winding.h"
#include "tangles.h"

namespace meshrepair::internal {

// Of the empty cells with a link to one of negative winding, says which are unbounded: those from
// which, or from some place connected with them along empty cells and along patches, a straight way
// leads to infinity that no triangle is in. False if of one it is certain neither that it is
// unbounded nor that it is in a cavity, with all cells of that known. `progress` is asked whether
// to go on.
[[nodiscard]] bool mark_outside(const CellComplex& complex, CellGraph& graph,
                                std::span<const char> beside, const Tangles& tangles,
                                const TangleWinding& winding, TangleRays& rays,
                                ProgressObserver* progress);

}  // namespace meshrepair::internal
