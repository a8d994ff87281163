// Small pieces of surface that have come off.
#pragma once

#include <cstddef>
#include <vector>

#include "agreed_triangles.h"

namespace meshrepair {

// Takes away the open parts, connected through edges, that have fewer triangles than this; returns
// how many triangles those were. In a hole they would become little solids of their own.
std::size_t drop_crumbs(std::vector<VotedTriangle>& triangles, std::size_t fewest);

}  // namespace meshrepair
