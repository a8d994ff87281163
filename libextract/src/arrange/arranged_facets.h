// SPDX-License-Identifier: MIT
// The facets into which triangles cut each other.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <base/progress.h>
#include <mesh/edge_table.h>

#include "arranged_points.h"
#include "cut_set.h"

namespace meshrepair::internal {

// Triangles that meet in corners and whole sides alone. Those of one cut triangle are next to each
// other, turned as it is, in the order of the cut ones.
struct ArrangedFacets {
  std::vector<IndexTriangle> corners;
  // Of each side 3 f + k: the side of the neighbour in the same triangle, where nothing else
  // meets it; kNone where something may.
  std::vector<std::uint32_t> across;
  std::vector<std::uint32_t> first;  // of each cut triangle its first facet, and the number of all
};

// `points` gets the points in which the pairs meet. `pairs` are all that meet beyond the corners
// and edges that they share. Nothing where triangles meet in ways that the pairs do not tell.
[[nodiscard]] std::optional<ArrangedFacets> arrange_facets(const CutSet& cut,
                                                           std::span<const CutSet::Pair> pairs,
                                                           std::optional<ArrangedPoints>& points,
                                                           ProgressObserver* progress);

}  // namespace meshrepair::internal
