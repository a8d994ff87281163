// SPDX-License-Identifier: MIT
// Into which connected regions the sheets divide space.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <base/progress.h>

#include "sheet_edges.h"
#include "stacks.h"

namespace meshrepair::internal {

struct Chambers {
  std::vector<std::uint32_t> front, behind;  // of each facet
  std::uint32_t count = 0;                   // number 0 is the outside
};

// Chambers meet around edges; around one with a single facet a chamber reaches both sides of that.
// Where a connected part of the surface starts, a ray says in which chamber of the others it lies.
// Nothing if no ray can tell: near the points of a part that are farthest out along each axis, all
// triangles are parallel to the axis, or cut there, or what the ray hits first it hits at an edge.
[[nodiscard]] std::optional<Chambers> find_chambers(const CutSet& cut, const ArrangedPoints& points,
                                                    const Sheets& sheets, const SheetEdges& edges,
                                                    const Stacks& stacks,
                                                    ProgressObserver* progress);

}  // namespace meshrepair::internal
