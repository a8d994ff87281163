// SPDX-License-Identifier: MIT
// Which of the kept facets may become one region, and which points its outline needs.
#pragma once

#include <cstdint>
#include <vector>

#include "kept_facets.h"
#include "sheet_edges.h"

namespace meshrepair::internal {

struct SheetRegions {
  std::vector<std::uint32_t> region;  // of each facet its region's lowest facet; kNone if not kept
  // Of each slot: its edge lies inside a region.
  std::vector<char> dissolved;
  // Of each point, whether triangles have to have a corner there.
  std::vector<char> needed;
};

struct MergeOptions {
  // Whether points may go where solids touch, after which two of them may have both ends of an edge
  // in common.
  bool releases_touching = true;
  bool merges_triangles = true;  // ExtractOptions has it
};

// Facets of one cut triangle are merged, and those of one plane, if that may be and none of the
// triangles is whole. A point goes that is inside a region, or inside a straight part of the
// outlines of all regions that meet there.
[[nodiscard]] SheetRegions merge_sheets(const CutSet& cut, const ArrangedPoints& points,
                                        const Sheets& sheets, const SheetEdges& edges,
                                        const KeptFacets& kept, const MergeOptions& options);

}  // namespace meshrepair::internal
