// SPDX-License-Identifier: MIT
// Pieces of triangles that lie in one place.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include <base/ids.h>

#include "sheet_edges.h"

namespace meshrepair::internal {

class Stacks {
 public:
  Stacks(const Sheets& sheets, const SheetEdges& edges);

  [[nodiscard]] bool contains(std::uint32_t facet) const {
    return !stack_of_.empty() && stack_of_[facet] != kNone;
  }
  // All that lie where a facet does that is contained, as for_each() has them.
  [[nodiscard]] std::span<const std::uint32_t> of(std::uint32_t facet) const {
    const auto less = [&](std::uint32_t a, std::uint32_t b) { return stack_of_[a] < stack_of_[b]; };
    const auto [first, last] = std::equal_range(facets_.begin(), facets_.end(), facet, less);
    return std::span(facets_).subspan(static_cast<std::size_t>(first - facets_.begin()),
                                      static_cast<std::size_t>(last - first));
  }
  // Calls visit(facets) for each: all in it, in the order of their triangles, which lie on each
  // other in this order along the normal of their plane.
  template <class Visit>
  void for_each(Visit visit) const {
    for (std::size_t i = 0; i < facets_.size();) {
      std::size_t end = i + 1;
      while (end < facets_.size() && stack_of_[facets_[end]] == stack_of_[facets_[i]]) ++end;
      visit(std::span(facets_).subspan(i, end - i));
      i = end;
    }
  }

 private:
  std::vector<std::uint32_t> stack_of_;  // of each facet; empty if there are none
  std::vector<std::uint32_t> facets_;    // by their stacks
};

}  // namespace meshrepair::internal
