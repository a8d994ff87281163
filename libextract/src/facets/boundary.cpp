// SPDX-License-Identifier: MIT
#include <extract/boundary.h>

namespace meshrepair {
namespace {

bool is_solid(const std::vector<char>& solid, CellId cell) {
  return cell.valid() && solid[cell.index()] != 0;
}

void add_polygon(const CellComplex& complex, FacetId f, bool as_stored, Boundary& boundary) {
  const auto number = static_cast<std::uint32_t>(boundary.facet.size());
  const UseId first = complex.facets[f].first_use;
  UseId u = first;
  do {
    boundary.use.push_back(u);
    boundary.polygon.push_back(number);
    u = as_stored ? complex.uses[u].next : complex.uses[u].previous;
  } while (u != first);
  boundary.facet.push_back(f);
  boundary.first.push_back(static_cast<std::uint32_t>(boundary.use.size()));
}

}  // namespace

Boundary find_boundary(const CellComplex& complex, const std::vector<char>& solid) {
  Boundary boundary;
  for (FacetId f(0u); f < complex.facets.end_id(); ++f.value) {
    const bool above = is_solid(solid, complex.facets[f].above);
    const bool below = is_solid(solid, complex.facets[f].below);
    // A facet is stored as seen from above; the empty side is where the surface is seen from.
    if (above != below) add_polygon(complex, f, below, boundary);
  }
  return boundary;
}

VertexId corner_vertex(const CellComplex& complex, const Boundary& boundary, std::uint32_t side,
                       const std::vector<char>& solid) {
  const Use& use = complex.uses[boundary.use[side]];
  return is_solid(solid, complex.facets[use.facet].below) ? complex.origin(use)
                                                          : complex.target(use);
}

}  // namespace meshrepair
