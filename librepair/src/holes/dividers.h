// SPDX-License-Identifier: MIT
// Walls that divide the inside of an open box, and end at nothing.
#pragma once

#include <span>
#include <vector>

#include <bsp/clean_soup.h>
#include <mesh/edge_table.h>

namespace meshrepair::internal {

// For each side of EdgeTable whether its edge is no rim, as both faces of its triangle look into
// rooms: into what the surface around it, closed at its rim by a cone, encloses. Also true where
// such a wall meets others. Empty where there is no such edge; a part without a rim, or with an
// open edge that has both faces outside, has none.
[[nodiscard]] std::vector<char> find_dividers(const CleanSoup& soup,
                                              std::span<const IndexTriangle> triangles,
                                              const EdgeTable& table);

}  // namespace meshrepair::internal
