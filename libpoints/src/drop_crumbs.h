// SPDX-License-Identifier: MIT
// Small pieces of surface that have come off.
#pragma once

#include <cstddef>
#include <vector>

#include "agreed_triangles.h"

namespace meshrepair {

// Takes away the open parts, connected through edges, that have fewer triangles than this; in a
// hole they would become little solids of their own. Takes away, too, what lies between points that
// are scattered in space: open parts of much fewer triangles than the part with the most, where few
// are wanted by all three corners, or which are `coarse` times as large (0: no matter how large).
// Returns how many triangles those were.
std::size_t drop_crumbs(std::vector<VotedTriangle>& triangles, std::size_t fewest, double coarse);

}  // namespace meshrepair
