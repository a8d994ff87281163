// SPDX-License-Identifier: MIT
#include "complex_edit.h"

#include <array>
#include <utility>

#include <base/assert.h>
#include <base/error.h>

namespace meshrepair::internal {
namespace {

void add_around(CellComplex& complex, UseId use) {
  Edge& edge = complex.edges[complex.uses[use].edge()];
  complex.uses[use].next_around = edge.first_use;
  edge.first_use = use;
}

void link(CellComplex& complex, UseId before, UseId after) {
  complex.uses[before].next = after;
  complex.uses[after].previous = before;
}

UseId new_use(CellComplex& complex, FacetId facet, EdgeId edge, std::uint32_t reversed) {
  const UseId use = complex.uses.push_back({facet, 2 * edge.value + reversed, {}, {}, {}});
  add_around(complex, use);
  return use;
}

void prepend_to_cell(CellComplex& complex, FacetId facet, CellId cell) {
  Facet& f = complex.facets[facet];
  (f.above == cell ? f.next_above : f.next_below) = complex.cells[cell].first_facet;
  complex.cells[cell].first_facet = facet;
}

EdgeId box_edge(CellComplex& complex, std::array<std::array<EdgeId, 8>, 8>& made, std::uint32_t a,
                std::uint32_t b, PlaneId p, PlaneId q) {
  EdgeId& edge = made[std::min(a, b)][std::max(a, b)];
  if (!edge.valid()) {
    edge =
        complex.edges.push_back({{VertexId(std::min(a, b)), VertexId(std::max(a, b))}, {p, q}, {}});
  }
  return edge;
}

}  // namespace

// Corner k of the box is high on axis a where bit a of k is set. Facet 2a is the low side on axis
// a, facet 2a+1 the high one; both planes' normals point along +a, so the box is above the low and
// below the high.
void make_box(CellComplex& complex, const GridBox& box) {
  const std::array<std::array<std::int32_t, 3>, 2> bounds = {
      {{box.low.x, box.low.y, box.low.z}, {box.high.x, box.high.y, box.high.z}}};
  for (std::uint32_t k = 0; k < 8; ++k) {
    complex.vertices.push_back(
        lattice_point({bounds[k & 1][0], bounds[(k >> 1) & 1][1], bounds[(k >> 2) & 1][2]}));
  }
  std::array<PlaneId, 6> plane;
  for (std::size_t side = 0; side < 6; ++side) {
    std::array<std::int64_t, 3> normal{};
    normal[side / 2] = 1;
    plane[side] = complex.planes.append(make_plane(normal, -bounds[side & 1][side / 2]));
  }
  const CellId cell = complex.cells.push_back({});
  std::array<std::array<EdgeId, 8>, 8> made{};
  for (std::uint32_t side = 0; side < 6; ++side) {
    const std::uint32_t axis = side / 2;
    const std::uint32_t u = 1u << ((axis + 1) % 3);
    const std::uint32_t v = 1u << ((axis + 2) % 3);
    const std::uint32_t base = (side & 1) != 0 ? 1u << axis : 0;
    const std::array<std::uint32_t, 4> loop = {base, base | u, base | u | v, base | v};
    Facet facet;
    facet.plane = plane[side];
    ((side & 1) != 0 ? facet.below : facet.above) = cell;
    const FacetId f = complex.facets.push_back(facet);
    std::array<UseId, 4> use;
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint32_t a = loop[i];
      const std::uint32_t b = loop[(i + 1) % 4];
      // The side facet that shares the edge a b: the axis on which neither the edge nor this facet
      // runs.
      const std::uint32_t across = i % 2 == 0 ? (axis + 2) % 3 : (axis + 1) % 3;
      const PlaneId other = plane[2 * across + ((a >> across) & 1)];
      const EdgeId edge = box_edge(complex, made, a, b, plane[side], other);
      use[i] = new_use(complex, f, edge, a < b ? 0 : 1);
    }
    for (std::size_t i = 0; i < 4; ++i) link(complex, use[i], use[(i + 1) % 4]);
    complex.facets[f].first_use = use[0];
    prepend_to_cell(complex, f, cell);
  }
}

VertexId split_edge(CellComplex& complex, EdgeId edge, const Point& at) {
  const VertexId vertex = complex.vertices.push_back(at);
  const Edge old = complex.edges[edge];
  const EdgeId rest = complex.edges.push_back({{vertex, old.ends[1]}, old.planes, {}});
  complex.edges[edge].ends[1] = vertex;
  for (UseId u = old.first_use; u.valid(); u = complex.uses[u].next_around) {
    const Use use = complex.uses[u];
    const UseId added = new_use(complex, use.facet, rest, use.reversed());
    if (use.reversed() != 0) {
      link(complex, use.previous, added);
      link(complex, added, u);
    } else {
      link(complex, added, use.next);
      link(complex, u, added);
    }
  }
  return vertex;
}

UseId find_mate(CellComplex& complex, UseId use, CellId cell) {
  Edge& edge = complex.edges[complex.uses[use].edge()];
  UseId before;
  for (UseId u = edge.first_use; u.valid(); u = complex.uses[u].next_around) {
    if (u != use && complex.bounds(complex.uses[u].facet, cell)) {
      if (before.valid()) {
        complex.uses[before].next_around = complex.uses[u].next_around;
        complex.uses[u].next_around = edge.first_use;
        edge.first_use = u;
      }
      return u;
    }
    before = u;
  }
  throw InternalError("internal error: an edge of a cell has only one facet");
}

FacetId split_facet(CellComplex& complex, FacetId facet, UseId from, UseId to, PlaneId by) {
  const Facet old = complex.facets[facet];
  const VertexId a = complex.origin(complex.uses[from]);
  const VertexId b = complex.origin(complex.uses[to]);
  const UseId before_from = complex.uses[from].previous;
  const UseId before_to = complex.uses[to].previous;
  const EdgeId edge = complex.edges.push_back({{a, b}, {old.plane, by}, {}});
  const FacetId added = complex.facets.push_back(old);

  const UseId back = new_use(complex, facet, edge, 1);   // b to a, closes from ... before_to
  const UseId forth = new_use(complex, added, edge, 0);  // a to b, closes to ... before_from
  link(complex, before_to, back);
  link(complex, back, from);
  link(complex, before_from, forth);
  link(complex, forth, to);
  for (UseId u = to; u != forth; u = complex.uses[u].next) complex.uses[u].facet = added;

  complex.facets[facet].first_use = from;
  complex.facets[added].first_use = to;
  // `added` is a copy, so it already points to what followed `facet` in both cells' lists.
  complex.facets[facet].next_above = added;
  complex.facets[facet].next_below = added;
  return added;
}

CellId separate_cell(CellComplex& complex, CellId cell, PlaneId by, std::span<const UseId> curve,
                     std::span<const FacetId> part, std::span<const FacetId> rest) {
  const CellId split_off = complex.cells.push_back({});
  Facet closing;
  closing.plane = by;
  closing.above = cell;
  closing.below = split_off;
  const FacetId lid = complex.facets.push_back(closing);

  // Seen from outside the part, the lid passes each edge against the direction of the part's own
  // facet, and the whole curve in the opposite order. A facet with the part below is stored as seen
  // from outside.
  UseId first;
  UseId previous;
  for (std::size_t i = curve.size(); i-- > 0;) {
    const Use passed = complex.uses[curve[i]];
    const bool stored_outward = complex.facets[passed.facet].below == cell;
    const std::uint32_t reversed = stored_outward ? 1 - passed.reversed() : passed.reversed();
    const UseId use = new_use(complex, lid, passed.edge(), reversed);
    if (previous.valid()) {
      link(complex, previous, use);
    } else {
      first = use;
    }
    previous = use;
  }
  link(complex, previous, first);
  complex.facets[lid].first_use = first;

  complex.cells[cell].first_facet = FacetId();
  for (const FacetId f : rest) prepend_to_cell(complex, f, cell);
  for (const FacetId f : part) {
    Facet& facet = complex.facets[f];
    (facet.above == cell ? facet.above : facet.below) = split_off;
    prepend_to_cell(complex, f, split_off);
  }
  prepend_to_cell(complex, lid, cell);
  prepend_to_cell(complex, lid, split_off);
  return split_off;
}

}  // namespace meshrepair::internal
