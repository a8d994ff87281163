// Which corners of boundary polygons are one vertex of the output (Gueziec et al. 2001; WM 4.4).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <extract/boundary.h>

namespace meshrepair {

struct ManifoldCorners {
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  std::vector<std::uint32_t> vertex;  // output vertex of the corner at the start of each side
  std::vector<std::uint32_t> middle;  // output vertex in the middle of each side, or kNone
  std::vector<std::uint32_t> vertex_corner;  // for each output vertex a side that starts at it ...
  std::vector<std::uint32_t> middle_side;    // ... then for each middle vertex a side it lies on
  std::size_t singular_edges = 0;            // with more than two polygons
  std::size_t singular_vertices = 0;         // that were copied, once for each fan

  [[nodiscard]] std::size_t vertices() const { return vertex_corner.size() + middle_side.size(); }
};

// Around an edge the polygons that bound the same solid wedge are joined, so solids that only touch
// are separated; around a vertex each fan of joined polygons gets a copy of its own. Where two
// wedges at an edge would still share both end vertices, all but the first get a vertex in the
// middle of the edge. The result is a closed 2-manifold, by construction. Linear, but for edges
// with very many polygons.
[[nodiscard]] ManifoldCorners cut_nonmanifold(const CellComplex& complex, const Boundary& boundary,
                                              const std::vector<char>& solid);

}  // namespace meshrepair
