// SPDX-License-Identifier: MIT
// Soups brought to cell complexes, for tests.
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include <exact/predicates.h>
#include <extract/build_cells.h>
#include <extract/cell_complex.h>
#include <extract/cover_facets.h>
#include <extract/extract_surface.h>
#include <mesh/topology.h>

#include "trees.h"

namespace meshrepair::testing {

// A complex and the tree that it refers to.
struct Cells {
  std::unique_ptr<Tree> tree;
  CellComplex complex;
  ClipReport clip;
};

inline Cells cells_of(const TriangleSoup& soup) {
  auto tree = std::make_unique<Tree>(tree_of(soup));
  ClipReport clip;
  CellComplex complex = build_cells(*tree, {}, clip);
  return {std::move(tree), std::move(complex), clip};
}

inline IdVector<TriangleId, std::int32_t> own_windings(const CleanSoup& soup) {
  IdVector<TriangleId, std::int32_t> winding;
  for (const Triangle& t : soup.triangles) winding.push_back(t.winding);
  return winding;
}

inline IdVector<FacetId, Cover> cover_of(Cells& cells) {
  CoverReport report;
  return cover_facets(cells.complex, own_windings(cells.tree->input), report);
}

inline std::set<VertexId> vertices_of(const CellComplex& complex, CellId cell) {
  std::set<VertexId> vertices;
  complex.for_each_facet(cell, [&](FacetId f) {
    complex.for_each_use(f, [&](UseId u) { vertices.insert(complex.origin(complex.uses[u])); });
  });
  return vertices;
}

// The mean of the cell's vertices, which is inside it, in the input's units.
inline Vec3d cell_centre(const CellComplex& complex, CellId cell) {
  std::array<double, 3> sum{};
  const std::set<VertexId> vertices = vertices_of(complex, cell);
  for (const VertexId v : vertices) {
    for (std::size_t i = 0; i < 3; ++i) sum[i] += complex.vertices[v].position[i];
  }
  for (double& x : sum) x /= static_cast<double>(vertices.size());
  return complex.soup().grid.from_grid(sum);
}

// Marks the cells whose centre satisfies `inside`.
template <class Inside>
std::vector<char> solid_where(const CellComplex& complex, Inside inside) {
  std::vector<char> solid;
  for (CellId c(0u); c < complex.cells.end_id(); ++c.value) {
    solid.push_back(inside(cell_centre(complex, c)) ? 1 : 0);
  }
  return solid;
}

// The cells that cannot be reached from the outer box without passing a covered facet.
inline std::vector<char> enclosed_cells(const CellComplex& complex,
                                        const IdVector<FacetId, Cover>& cover) {
  std::vector<char> inside(complex.cells.size(), 1);
  std::vector<CellId> queue;
  const auto reach = [&](CellId cell) {
    if (inside[cell.index()] == 0) return;
    inside[cell.index()] = 0;
    queue.push_back(cell);
  };
  for (const Facet& f : complex.facets) {
    if (!f.above.valid()) reach(f.below);
    if (!f.below.valid()) reach(f.above);
  }
  while (!queue.empty()) {
    const CellId cell = queue.back();
    queue.pop_back();
    complex.for_each_facet(cell, [&](FacetId f) {
      const Facet& facet = complex.facets[f];
      if (cover[f].opaque() || !facet.above.valid() || !facet.below.valid()) return;
      reach(facet.above == cell ? facet.below : facet.above);
    });
  }
  return inside;
}

// Every cell is the convex body that its facets' planes cut out: exactly.
inline void expect_convex_cells(const CellComplex& complex) {
  for (CellId c(0u); c < complex.cells.end_id(); ++c.value) {
    const std::set<VertexId> vertices = vertices_of(complex, c);
    complex.for_each_facet(c, [&](FacetId f) {
      const Facet& facet = complex.facets[f];
      const int inside = facet.above == c ? 1 : -1;
      int strictly = 0;
      for (const VertexId v : vertices) {
        const int s = side(complex.vertices[v], facet.plane, complex.planes);
        ASSERT_GE(s * inside, 0) << "vertex " << v.value << " facet " << f.value;
        strictly += s != 0;
      }
      ASSERT_GT(strictly, 0);
      complex.for_each_use(f, [&](UseId u) {
        const VertexId v = complex.origin(complex.uses[u]);
        ASSERT_EQ(side(complex.vertices[v], facet.plane, complex.planes), 0);
      });
    });
  }
}

inline void expect_closed_manifold(const TriangleSoup& mesh) {
  const Topology t = examine_topology(mesh.triangles, mesh.points.size());
  EXPECT_TRUE(t.closed());
  EXPECT_TRUE(t.manifold());
  EXPECT_TRUE(t.oriented());
}

}  // namespace meshrepair::testing
