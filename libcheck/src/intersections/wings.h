// SPDX-License-Identifier: MIT
// The triangles around edges at which several sheets of a surface meet.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <base/parallel.h>
#include <check/internal/triangle_list.h>
#include <mesh/edge_table.h>

namespace meshrepair::internal {

// A triangle at an edge. A sheet has two of them at an edge of two indices; where other points are
// in the same place as one of its ends, other sheets may have an edge there.
struct Wing {
  std::array<std::uint32_t, 2> edge;  // in indices of the soup, ascending: names the sheet
  std::uint32_t triangle;
  bool forward;             // passes the edge from its lower corner to its higher one
  std::array<Vec3d, 3> at;  // the lower corner, the higher one, and the tip
  // Where the tip lies seen from the first wing: 0 in the same half plane, 1 before half a turn, 2
  // at half a turn, 3 after it.
  int quarter = 0;
};

// Of the wings at one edge, those of sheets of two, in the order in which one meets them going
// round the edge, to where the normal of a forward one points; none where two leave in the same
// direction, for these overlap, or where there are less than two sheets. Exact.
[[nodiscard]] std::vector<Wing> order_around_edge(std::span<const Wing> group);

// Edges with an end where points of several indices are. `corners` is welded.
class SharedEdges {
 public:
  explicit SharedEdges(const SoupCorners& corners);

  // What join(all, part) makes of parts that start as Part{} and are given to visit(part, wings)
  // for each edge of several sheets, in order, with what order_around_edge() gives. On several
  // threads.
  template <class Part, class Visit, class Join>
  [[nodiscard]] Part gather(const Visit& visit, const Join& join) const {
    constexpr std::size_t kEdgesPerTask = 4096;
    const EdgeTable table(places_);
    const auto visit_some = [&](std::size_t first, std::size_t last) {
      Part part{};
      for (std::size_t edge = first; edge < last; ++edge) {
        if (table.sides(edge).size() < 4) continue;  // one sheet
        const std::vector<Wing> wings = wings_at(table.sides(edge));
        if (!wings.empty()) visit(part, wings);
      }
      return part;
    };
    return parallel_reduce(table.edges(), kEdgesPerTask, visit_some, join);
  }

 private:
  [[nodiscard]] std::vector<Wing> wings_at(std::span<const std::uint32_t> sides) const;

  const SoupCorners& corners_;
  std::vector<IndexTriangle> places_;     // the corners of each triangle that may have a wing
  std::vector<std::uint32_t> triangles_;  // which of the soup it is
};

}  // namespace meshrepair::internal
