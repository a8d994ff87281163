// SPDX-License-Identifier: MIT
// All facets of a soup whose triangles were cut, and in which order they lie around their edges.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <base/progress.h>
#include <bsp/clean_soup.h>
#include <mesh/edge_table.h>

#include "arranged_facets.h"
#include "arranged_points.h"
#include "cut_set.h"

namespace meshrepair::internal {

// The facets of cut triangles, and the others as they are: in the order of the soup's triangles,
// turned as these are. Slot 3 f + k is side k of facet f.
struct Sheets {
  std::vector<IndexTriangle> corners;   // points of the arrangement
  std::vector<std::uint32_t> triangle;  // of the soup, of each facet
  std::vector<std::uint32_t> first;     // of each triangle its first facet, and the number of all
  std::vector<std::uint32_t> across;    // as ArrangedFacets has it; kNone for triangles not cut

  [[nodiscard]] std::size_t size() const { return corners.size(); }
};

[[nodiscard]] Sheets join_sheets(const CutSet& cut, const ArrangedFacets& facets,
                                 const ArrangedPoints& points);

// The edges of the sheets but for those inside a triangle that nothing else meets.
class SheetEdges {
 public:
  SheetEdges(const CutSet& cut, const ArrangedPoints& points, const Sheets& sheets,
             ProgressObserver* progress);

  [[nodiscard]] std::size_t size() const { return first_.size() - 1; }
  // The slots of an edge, counter-clockwise as seen against its direction from its lower point to
  // its higher one. Facets that lie in the same place there follow each other, in the order of
  // their triangles along their plane's normal.
  [[nodiscard]] std::span<const std::uint32_t> slots(std::size_t edge) const {
    return {slots_.data() + first_[edge], first_[edge + 1] - first_[edge]};
  }
  // Whether the facet of a slot lies where that of the slot before it in the list lies.
  [[nodiscard]] bool lies_on_previous(std::size_t edge, std::size_t i) const {
    return !on_previous_.empty() && on_previous_[first_[edge] + i] != 0;
  }
  // Whether the slot leads from the lower point to the higher one: then what comes after it around
  // the edge is in front of its facet.
  [[nodiscard]] bool leads_up(std::uint32_t slot) const {
    return side_start(sheets_.corners, slot) < side_start(sheets_.corners, next_side(slot));
  }

 private:
  void sort_around(std::size_t edge);

  const CutSet& cut_;
  const ArrangedPoints& points_;
  const Sheets& sheets_;
  std::vector<std::uint32_t> slots_, first_;
  std::vector<char> on_previous_;  // empty if no two facets lie in one place
};

}  // namespace meshrepair::internal
