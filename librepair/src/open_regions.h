// Solid regions around which too little is closed.
#pragma once

#include <cstddef>
#include <vector>

#include <bsp/clean_soup.h>

#include "covered_cells.h"

namespace meshrepair::internal {

// Of each triangle, whether its part, connected through edges, has an edge with one triangle. Those
// that are there as often the one way as the other are no part of it, and open themselves.
[[nodiscard]] std::vector<char> triangles_of_open_parts(const CleanSoup& soup);

// Makes empty what only open parts surround, if all of their triangles around it lie in one plane
// but for the rounding of their coordinates, or if what no triangle covers is about as large as
// they are: under a sheet that is hardly bent, or a bump of one. `solid` has an entry for each
// cell. Returns how many connected regions became empty.
std::size_t empty_open_regions(const CoveredCells& covered, std::vector<char>& solid);

}  // namespace meshrepair::internal
