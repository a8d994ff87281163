// SPDX-License-Identifier: MIT
// The triangles around an edge, in the order in which one meets them going round it.
#pragma once

#include <cstdint>
#include <span>

#include <bsp/clean_soup.h>
#include <mesh/edge_table.h>

namespace meshrepair::internal {

// Sorts sides of EdgeTable that run along one and the same edge by the direction in which their
// triangles leave it, going round the edge once, the first side staying the first. Exact. False,
// the order then being without meaning, when two of them leave in the same direction.
[[nodiscard]] bool sort_around_edge(const CleanSoup& soup, std::span<const IndexTriangle> triangles,
                                    std::span<std::uint32_t> sides);

}  // namespace meshrepair::internal
