// SPDX-License-Identifier: MIT
// Which facets lie between two regions, each a union of chambers, and how they are joined at edges.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "kept_facets.h"

namespace meshrepair::internal {

// Those between two regions are kept, turned so that the region with the higher number is behind.
// At an edge with two of them both lie between the same regions and are joined; one with more is
// singular, and they are joined in turn.
struct RegionFacets {
  KeptFacets kept;
  std::vector<std::array<std::uint32_t, 2>> regions;  // of each kept facet, in front and behind
};

// `region`: of each chamber.
[[nodiscard]] RegionFacets keep_facets_between(const CleanSoup& soup, const Sheets& sheets,
                                               const SheetEdges& edges, const Stacks& stacks,
                                               const Chambers& chambers,
                                               std::span<const std::uint32_t> region);

}  // namespace meshrepair::internal
