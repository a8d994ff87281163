// SPDX-License-Identifier: MIT
// The open edges of a soup, and the corners on them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <mesh/edge_table.h>
#include <mesh/soup.h>

namespace meshrepair::internal {

struct OpenRims {
  std::vector<std::uint32_t> place;  // of each point the first one that is there
  // Of the soup, with the first point that has its place instead of each; those that are not
  // finite, or have two corners in one place, have no open edges.
  std::vector<IndexTriangle> triangles;
  std::vector<std::uint32_t> sides;    // of one triangle alone; 3 t + k from its corner k on
  std::vector<std::uint32_t> corners;  // ends of these, ascending
  std::vector<double> size;            // of each point that is one: the shortest edge there
  std::vector<std::uint32_t> open_at;  // of each point: how many open edges end there
  std::vector<char> is_crowded;        // of each point: does an edge of more than two end there?
};

[[nodiscard]] OpenRims find_open_rims(const TriangleSoup& soup);

// The two ends of a side.
[[nodiscard]] inline std::array<std::uint32_t, 2> ends_of(const OpenRims& rims,
                                                          std::uint32_t side) {
  return {side_start(rims.triangles, side), side_start(rims.triangles, next_side(side))};
}

}  // namespace meshrepair::internal
