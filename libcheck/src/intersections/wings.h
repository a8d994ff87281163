// The triangles around edges at which several sheets of a surface meet.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <check/triangle_list.h>

namespace meshrepair::internal {

// A triangle at an edge. A sheet has two of them at an edge of two indices; where other points are
// in the same place as one of its ends, other sheets may have an edge there.
struct Wing {
  std::array<std::uint32_t, 2> place;  // of the edge: corners, ascending
  std::array<std::uint32_t, 2> edge;   // in indices of the soup, ascending: names the sheet
  std::uint32_t triangle;
  bool forward;             // passes the edge in the order of `place`
  std::array<Vec3d, 3> at;  // the ends in the order of `place`, and the tip
  // Where the tip lies seen from the first wing: 0 in the same half plane, 1 before half a turn, 2
  // at half a turn, 3 after it.
  int quarter = 0;
};

// All at edges with an end where points of several indices are, edge by edge. `corners` is welded.
[[nodiscard]] std::vector<Wing> find_wings(const SoupCorners& corners);

// Of the wings at one edge, those of sheets of two, in the order in which one meets them going
// round the edge, to where the normal of a forward one points; none where two leave in the same
// direction, for these overlap, or where there are less than two sheets. Exact.
[[nodiscard]] std::vector<Wing> order_around_edge(std::span<const Wing> group);

// Calls visit(wings) for each edge of several sheets, with what order_around_edge() gives.
template <class Visit>
void visit_shared_edges(const SoupCorners& corners, const Visit& visit) {
  const std::vector<Wing> all = find_wings(corners);
  for (std::size_t i = 0; i < all.size();) {
    std::size_t end = i;
    while (end < all.size() && all[end].place == all[i].place) ++end;
    const std::vector<Wing> wings = order_around_edge({all.data() + i, end - i});
    if (!wings.empty()) visit(wings);
    i = end;
  }
}

}  // namespace meshrepair::internal
