// SPDX-License-Identifier: MIT
// Middle vertices of edges along which a solid touches itself.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <mesh/soup.h>

#include "kept_facets.h"
#include "sheet_edges.h"
#include "sheet_regions.h"

namespace meshrepair::internal {

// Where more than two facets meet at an edge, and two pairs of those that are joined have both ends
// in common, the edge would be one of four triangles. Each of its pairs gets a middle vertex of its
// own; then no two of its halves have the same ends.
class TouchingMiddles {
 public:
  // None at all.
  TouchingMiddles() = default;
  // `fan` says of each slot which vertex it starts at.
  TouchingMiddles(const SheetEdges& edges, const KeptFacets& kept, const SheetRegions& regions,
                  const std::vector<std::uint32_t>& fan);

  [[nodiscard]] std::size_t size() const { return count_; }
  // Of the side from one vertex to another of a triangle of this region: its number, or kNone.
  [[nodiscard]] std::uint32_t find(std::uint32_t region, std::uint32_t from,
                                   std::uint32_t to) const;

 private:
  // A side of a kept facet, as the surface passes it.
  struct Side {
    std::array<std::uint32_t, 3> key;  // region, from, to
    std::uint32_t middle;
  };

  std::vector<Side> sides_;  // by their keys
  std::size_t count_ = 0;
};

// What becomes of a triangle whose sides have these middles, or kNone. They follow in `pieces`.
void split_at_middles(const IndexTriangle& corners, const IndexTriangle& middles,
                      std::vector<IndexTriangle>& pieces);

}  // namespace meshrepair::internal
