// SPDX-License-Identifier: MIT
// Pieces of space that the surface winds around the wrong way.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <base/ids.h>
#include <repair/cell_graph.h>

namespace meshrepair::internal {

struct OuterPockets {
  std::size_t left_out = 0;
  std::vector<char> is_left_out;  // of each cell; empty: none is
};

// A surface that crosses itself may wind the wrong way around a piece of space, like one half of a
// bow tie: the winding numbers w are negative there. What so borders the outside is solid as well,
// in a cavity it is not. Such pockets are given the opposite sign, but for two kinds, which are
// given 0: folds of a part of the surface, thin like slivers, and what lies between a patch over a
// hole and the surface under it, if they are small beside the solid that the part bounds. Linear in
// the number of links. `solid_area` is what solid_areas() gives, of the whole surface.
[[nodiscard]] OuterPockets turn_outer_pockets(const CellGraph& graph,
                                              const IdVector<TriangleId, std::uint32_t>& part_of,
                                              const std::vector<double>& solid_area,
                                              std::vector<double>& w);

// Of each part, the area of its triangles of the input on those links of the graph that bound
// solid, in square grid steps; 0 for parts that have no such link, up to the last one.
[[nodiscard]] std::vector<double> solid_areas(const CellGraph& graph,
                                              const IdVector<TriangleId, std::uint32_t>& part_of,
                                              const std::vector<double>& w);

}  // namespace meshrepair::internal
