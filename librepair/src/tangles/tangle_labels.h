// What is solid around the tangles of a soup, whose cells alone are divided, and beside the rest.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <base/progress.h>
#include <bsp/tree.h>
#include <repair/inside_rule.h>
#include <repair/orient_parts.h>
#include <repair/thin_cells.h>

#include "cells/covered_cells.h"
#include "tangle_winding.h"
#include "tangles.h"

namespace meshrepair::internal {

// Of a patch of triangles that are not tangled, as Tangles::winding turns them.
struct PatchSides {
  bool solid_in_front = false, solid_behind = false;
  bool operator==(const PatchSides&) const = default;
};

struct TangleLabels {
  std::vector<char> solid;  // of each cell; not of those that were left undivided
  // Of each cell: undivided ones are unknown, those that have a facet in common with one are fixed.
  std::vector<CellState> states;
  std::vector<PatchSides> patches;
  std::size_t links = 0;  // between cells that are known
};

// The triangles of patches, ascending, beside which cells are not as their patch says.
[[nodiscard]] std::vector<std::uint32_t> find_disagreements(const TangleLabels& labels,
                                                            const CoveredCells& covered,
                                                            const Tangles& tangles,
                                                            const Orientation& orientation);

// What label_cells() says of all cells of the soup, for InsideRule::winding, and for `automatic`
// where all parts are believed. `tree` leaves undivided only what no tangled triangle touches; the
// cover has the windings of the orientation. Nothing where cells farther away would have to be
// looked at: where space is wound around the wrong way by parts that do not all face outward, or is
// not seen from outside.
[[nodiscard]] std::optional<TangleLabels> label_tangles(
    const Tree& tree, const CoveredCells& covered, const Tangles& tangles,
    const Orientation& orientation, TangleRays& rays, const InsideOptions& options,
    InsideReport& report);

}  // namespace meshrepair::internal
