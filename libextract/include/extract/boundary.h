// SPDX-License-Identifier: MIT
// The facets between solid and empty cells, as polygons (WM Procedure 1).
#pragma once

#include <cstdint>
#include <vector>

#include <extract/cell_complex.h>

namespace meshrepair {

// Polygon p has the sides first[p] to first[p + 1] - 1, in order, counter-clockwise seen from the
// empty side. Side i runs along edge use[i] of the complex, starting at corner i.
struct Boundary {
  std::vector<FacetId> facet;
  std::vector<std::uint32_t> first = {0};
  std::vector<UseId> use;
  std::vector<std::uint32_t> polygon;  // of each side

  [[nodiscard]] std::size_t polygons() const { return facet.size(); }
  [[nodiscard]] std::size_t sides() const { return use.size(); }
  [[nodiscard]] std::uint32_t next(std::uint32_t side) const {
    const std::uint32_t p = polygon[side];
    return side + 1 < first[p + 1] ? side + 1 : first[p];
  }
  [[nodiscard]] std::uint32_t previous(std::uint32_t side) const {
    const std::uint32_t p = polygon[side];
    return side > first[p] ? side - 1 : first[p + 1] - 1;
  }
};

// `solid` says for each cell whether it is part of the solid; what lies outside the box is empty.
[[nodiscard]] Boundary find_boundary(const CellComplex& complex, const std::vector<char>& solid);

// The complex vertex at the start of a side.
[[nodiscard]] VertexId corner_vertex(const CellComplex& complex, const Boundary& boundary,
                                     std::uint32_t side, const std::vector<char>& solid);

}  // namespace meshrepair
