// SPDX-License-Identifier: MIT
// The only functions that change the topology of a complex. Each leaves all its invariants intact.
#pragma once

#include <span>

#include <extract/cell_complex.h>

namespace meshrepair::internal {

// The first cell.
void make_box(CellComplex& complex, const GridBox& box);

// Puts a vertex into an edge; the edge keeps the part from ends[0], the new edge gets the rest. All
// facets around it follow.
VertexId split_edge(CellComplex& complex, EdgeId edge, const Point& at);

// CellComplex::mate(), which it also moves to the front of the ring around the edge. Thousands of
// facets may share an edge, but those of the cells that are cut now are asked for again and again.
UseId find_mate(CellComplex& complex, UseId use, CellId cell);

// Splits a facet by an edge from the origin of `from` to the origin of `to`, uses of its loop that
// are not neighbours. The facet keeps the part that starts with `from`; the part that starts with
// `to` becomes the new facet, which is returned. The line of the new edge is that of the facet's
// plane and `by`.
FacetId split_facet(CellComplex& complex, FacetId facet, UseId from, UseId to, PlaneId by);

// Separates a cell along a closed curve of its edges. `curve` holds uses of facets of the part that
// is split off, one for each edge of the curve, in the order in which those facets pass them seen
// from outside the cell; `part` holds that part's facets. A facet with plane `by` closes both; it
// points from the part to the rest. Returns the new cell, which is the part.
CellId separate_cell(CellComplex& complex, CellId cell, PlaneId by, std::span<const UseId> curve,
                     std::span<const FacetId> part, std::span<const FacetId> rest);

}  // namespace meshrepair::internal
