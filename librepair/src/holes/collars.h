// SPDX-License-Identifier: MIT
// The surface around each hole.
#pragma once

#include <span>
#include <vector>

#include <bsp/clean_soup.h>
#include <mesh/topology.h>

#include "boundary_loops.h"
#include "curve_patch.h"

namespace meshrepair::internal {

// The collar of each loop, in grid coordinates.
[[nodiscard]] std::vector<Collar> find_collars(const CleanSoup& soup,
                                               std::span<const IndexTriangle> triangles,
                                               const BoundaryLoops& loops);

}  // namespace meshrepair::internal
