// SPDX-License-Identifier: MIT
// Which facets bound the solid, and how they are joined at edges.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <base/progress.h>
#include <extract/cut_nonmanifold.h>

#include "chambers.h"
#include "sheet_edges.h"
#include "stacks.h"

namespace meshrepair::internal {

enum class Kept : std::uint8_t { no, as_turned, turned_round };

struct KeptFacets {
  std::vector<Kept> kept;            // of each facet
  std::vector<std::uint8_t> places;  // of each triangle, see Arrangement::places()
  // Of each slot of a kept facet the slot that it is joined to; kNone for others.
  std::vector<std::uint32_t> mate;
  // Of each slot whether more than two kept facets meet at its edge.
  std::vector<char> singular;
  std::size_t singular_edges = 0;
  bool is_between_regions = false;  // as RegionFacets has them
  bool closed = true;  // an even number of facets at each edge, solid and empty in turn
};

// `solid`: of each chamber.
[[nodiscard]] KeptFacets keep_facets(const CleanSoup& soup, const Sheets& sheets,
                                     const SheetEdges& edges, const Stacks& stacks,
                                     const Chambers& chambers, const std::vector<char>& solid,
                                     Touching touching);

}  // namespace meshrepair::internal
