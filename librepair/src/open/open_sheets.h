// Sheets that enclose nothing, and solid regions around which too little is closed.
#pragma once

#include <cstddef>
#include <vector>

#include <bsp/clean_soup.h>

#include "cells/covered_cells.h"

namespace meshrepair::internal {

// All triangles but those that close holes, of which there are some, are of open parts, and lie in
// one plane but for the rounding.
[[nodiscard]] bool is_flat_sheet(const CleanSoup& soup);

// Of each triangle, whether its part, connected through edges, lies in one plane but for the
// rounding.
[[nodiscard]] std::vector<char> triangles_of_flat_parts(const CleanSoup& soup);

// Makes empty what only open parts surround, if all of their triangles around it lie in one plane
// but for the rounding of their coordinates, or if what no triangle covers is about as large as
// they are: under a sheet that is hardly bent, or a bump of one. `solid` has an entry for each
// cell. Returns how many regions became empty; they are connected through what no triangle covers.
std::size_t empty_open_regions(const CoveredCells& covered, std::vector<char>& solid);

}  // namespace meshrepair::internal
