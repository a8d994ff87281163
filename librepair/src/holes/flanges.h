// SPDX-License-Identifier: MIT
// The openings that lie inside a flange: a flat or wavy ring that a cup ends in.
#pragma once

#include <span>
#include <vector>

#include <base/progress.h>
#include <bsp/clean_soup.h>
#include <mesh/edge_table.h>

#include "boundary_loops.h"

namespace meshrepair::internal {

// A patch over the outer rim of a flange would lie on the flange. The opening to close is where the
// flange begins.
struct Flanges {
  std::vector<char> is_outer_rim;  // of each loop; empty if none is
  // Where the flanges begin, with the sides of triangles that lie beyond them.
  BoundaryLoops openings;
};

// A flange goes inward from the loop, within 45 degrees of the loop's plane, and within the loop.
// It has less area than what it belongs to: the ground around a hill is no flange. `loops` are
// those of the soup.
[[nodiscard]] Flanges find_flanges(const CleanSoup& soup, std::span<const IndexTriangle> triangles,
                                   const EdgeTable& table, const BoundaryLoops& loops,
                                   ProgressObserver* progress);

}  // namespace meshrepair::internal
