// SPDX-License-Identifier: MIT
// Soups brought to cell graphs, for tests.
#pragma once

#include <utility>

#include <repair/cell_graph.h>
#include <repair/orient_parts.h>

#include "complexes.h"

namespace meshrepair::testing {

struct Graph {
  Cells cells;
  IdVector<FacetId, Cover> cover;
  CellGraph graph;
  Orientation orientation;
};

inline Graph graph_of(const TriangleSoup& soup) {
  Cells cells = cells_of(soup);
  IdVector<FacetId, Cover> cover = cover_of(cells);
  CellGraph graph(cells.complex, cover);
  OrientReport report;
  Orientation orientation = orient_parts(cells.tree->input, report);
  return {std::move(cells), std::move(cover), std::move(graph), std::move(orientation)};
}

// Volume of the cells marked, in the input's units.
inline double volume_where(const Graph& g, const std::vector<char>& marked) {
  double sum = 0;
  for (CellId c(0u); c < g.cells.complex.cells.end_id(); ++c.value) {
    if (marked[c.index()] != 0) sum += cell_volume(g.cells.complex, c);
  }
  const double unit = g.cells.tree->input.grid.unit;
  return sum * unit * unit * unit;
}

}  // namespace meshrepair::testing
