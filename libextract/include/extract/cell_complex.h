// SPDX-License-Identifier: MIT
// The cell complex: convex cells, the facets between them, their edges and vertices.
//
// Notation: every facet lies in a plane and is a simple loop of uses. A use is one facet's passage
// along one edge, in a direction; the uses around an edge form a ring list. A facet is
// counter-clockwise seen from where its plane's normal points; the cell there is `above`, the other
// `below` (invalid: outside the box). All elements live in pools, are named by 32-bit ids, and are
// never removed.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <base/ids.h>
#include <bsp/clean_soup.h>
#include <bsp/tree.h>
#include <exact/plane_table.h>
#include <exact/point.h>

namespace meshrepair {

// Uses name them with their direction, in 32 bits.
template <>
struct IdKind<struct EdgeTag> {
  static constexpr std::size_t kMost = (std::size_t{1} << 31) - 1;
  static constexpr const char* kName = "edges of cells";
};

using VertexId = Id<struct VertexTag>;
using EdgeId = Id<struct EdgeTag>;
using UseId = Id<struct UseTag>;
using FacetId = Id<struct FacetTag>;
using CellId = Id<struct CellTag>;

struct Edge {
  std::array<VertexId, 2> ends;
  std::array<PlaneId, 2> planes;  // two planes whose common line carries the edge
  UseId first_use;
};

struct Use {
  FacetId facet;
  // Twice the edge's number, plus 1 when it is passed from ends[1] to ends[0]. Uses are most of a
  // complex's memory, hence the packing.
  std::uint32_t directed_edge = ~std::uint32_t{0};
  UseId next, previous;  // in the facet's loop
  UseId next_around;     // the next use of the same edge; the last is followed by an invalid id

  [[nodiscard]] EdgeId edge() const { return EdgeId(directed_edge >> 1); }
  [[nodiscard]] std::uint32_t reversed() const { return directed_edge & 1; }
};

struct Facet {
  PlaneId plane;
  UseId first_use;
  CellId above, below;
  FacetId next_above, next_below;  // the next facet in the list of the cell above, below
  // Input triangles in this plane that may cover part of it: a range of facet_triangles.
  std::uint32_t first_triangle = 0;
  std::uint32_t triangle_count = 0;
};

struct Cell {
  FacetId first_facet;
  LeafId leaf;
};

class CellComplex {
 public:
  // A single cell: the box. `soup` must outlive the complex; its planes are copied and keep their
  // ids.
  CellComplex(const CleanSoup& soup, const GridBox& box);

  [[nodiscard]] const CleanSoup& soup() const { return *soup_; }
  [[nodiscard]] VertexId origin(const Use& use) const {
    return edges[use.edge()].ends[use.reversed()];
  }
  [[nodiscard]] VertexId target(const Use& use) const {
    return edges[use.edge()].ends[1 - use.reversed()];
  }
  [[nodiscard]] bool bounds(FacetId facet, CellId cell) const {
    return facets[facet].above == cell || facets[facet].below == cell;
  }
  [[nodiscard]] FacetId next_facet(FacetId facet, CellId cell) const {
    const Facet& f = facets[facet];
    return f.above == cell ? f.next_above : f.next_below;
  }
  // The other plane of the edge: with the facet's own it gives the edge's line.
  [[nodiscard]] PlaneId side_plane(const Use& use) const {
    const Edge& edge = edges[use.edge()];
    return edge.planes[0] == facets[use.facet].plane ? edge.planes[1] : edge.planes[0];
  }
  // The use of the same edge by the cell's other facet.
  [[nodiscard]] UseId mate(UseId use, CellId cell) const;

  // Calls visit(FacetId) for every facet of the cell.
  template <class Visit>
  void for_each_facet(CellId cell, Visit visit) const {
    for (FacetId f = cells[cell].first_facet; f.valid();) {
      const FacetId next = next_facet(f, cell);
      visit(f);
      f = next;
    }
  }
  // Calls visit(UseId) for every use of the facet's loop, in order.
  template <class Visit>
  void for_each_use(FacetId facet, Visit visit) const {
    const UseId first = facets[facet].first_use;
    UseId use = first;
    do {
      const UseId next = uses[use].next;
      visit(use);
      use = next;
    } while (use != first);
  }

  PlaneTable planes;  // the soup's, then planes of the box and of triangle edges
  IdVector<VertexId, Point> vertices;
  IdVector<EdgeId, Edge> edges;
  IdVector<UseId, Use> uses;
  IdVector<FacetId, Facet> facets;
  IdVector<CellId, Cell> cells;
  TrivialVector<TriangleId> facet_triangles;
  // Made by predicates that may be wrong: cells and facets need not be convex, nor facets flat, and
  // two edges may have the same ends. The topology is sound all the same.
  bool loose = false;

 private:
  const CleanSoup* soup_;
};

// Area of a facet in grid units, from rounded coordinates: not negative, for weights, never for
// decisions.
[[nodiscard]] double facet_area(const CellComplex& complex, FacetId facet);

struct FacetMeasure {
  double area = 0;
  // The volume between the facet and the origin, on the side below it: summed over the facets of a
  // cell, those that it is above negative, its volume.
  double moment = 0;
};

// As facet_area().
[[nodiscard]] FacetMeasure measure_facet(const CellComplex& complex, FacetId facet);

// Volume of a cell in grid units, from rounded coordinates.
[[nodiscard]] double cell_volume(const CellComplex& complex, CellId cell);

// The mean of the facet's vertices.
[[nodiscard]] std::array<double, 3> facet_centre(const CellComplex& complex, FacetId facet);

}  // namespace meshrepair
