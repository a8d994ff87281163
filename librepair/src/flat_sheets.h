// Open sheets that lie in one plane, but for the rounding of their coordinates. They enclose
// nothing, yet on the working grid their two sides may seem to.
#pragma once

#include <cstddef>
#include <vector>

#include <bsp/clean_soup.h>

#include "covered_cells.h"

namespace meshrepair::internal {

// Of each triangle, whether its part, connected through edges, has an edge with one triangle.
[[nodiscard]] std::vector<char> triangles_of_open_parts(const CleanSoup& soup);

// In grid units, how far a point may be from where it was meant: it was put on the grid, and may
// have been rounded to single precision before, where all coordinates are such numbers.
[[nodiscard]] double rounding_of(const CleanSoup& soup);

// All the triangles, of which there are some, lie in one plane but for the rounding, and some edge
// has one triangle alone.
[[nodiscard]] bool is_flat_sheet(const CleanSoup& soup);

// Makes empty what is solid where all triangles around lie in one plane but for the rounding, and
// belong to open parts. `solid` has an entry for each cell. Returns how many connected regions it
// were.
std::size_t empty_flat_regions(const CoveredCells& covered, std::vector<char>& solid);

}  // namespace meshrepair::internal
