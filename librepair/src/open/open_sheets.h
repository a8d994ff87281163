// SPDX-License-Identifier: MIT
// Sheets that enclose nothing, and solid regions around which too little is closed.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <bsp/clean_soup.h>
#include <mesh/edge_table.h>
#include <repair/cell_graph.h>

namespace meshrepair::internal {

// In grid units, how far a point may be from where it was meant: it was put on the grid, and may
// have been rounded to single precision before, where all coordinates are such numbers.
[[nodiscard]] double rounding_of(const CleanSoup& soup);

// All triangles but those that close holes, of which there are some, are of open parts, and lie in
// one plane but for the rounding.
[[nodiscard]] bool is_flat_sheet(const CleanSoup& soup);

// Of each triangle, whether its part, connected through edges, lies in one plane but for the
// rounding.
[[nodiscard]] std::vector<char> triangles_of_flat_parts(const CleanSoup& soup);

// Makes empty what only open parts surround, if all of their triangles around it lie in one plane
// but for the rounding of their coordinates, or if what no triangle covers is about as large as
// they are: under a sheet that is hardly bent, or a bump of one; then, if less than a tenth of each
// of these parts bounds something solid: crumbs of a sheet. The graph may be that of some of the
// soup's triangles; `solid` has an entry for each of its cells. Returns how many regions became
// empty; they are connected through what no triangle covers.
std::size_t empty_open_regions(const CellGraph& graph, const CleanSoup& soup,
                               std::vector<char>& solid);

// The original place of the point, in grid units.
[[nodiscard]] Vec3d original_place(const CleanSoup& soup, PointId point);

// Whether all points, of which there are some, lie in one plane, each off by no more than
// `rounding`: the plane of three that are far from each other tells.
[[nodiscard]] bool is_flat(const std::vector<Vec3d>& points, double rounding);

}  // namespace meshrepair::internal
