// SPDX-License-Identifier: MIT
#include <set>
#include <string>

#include <gtest/gtest.h>

#include <repair/cell_graph.h>

#include "degenerate_soups.h"
#include "graphs.h"

namespace meshrepair {
namespace {

using namespace testing;

TEST(CellGraph, EveryLinkIsListedAtBothItsEnds) {
  for (const SoupFamily& family : degenerate_families()) {
    SCOPED_TRACE(family.name);
    const Graph g = graph_of(family.make(1));
    const CellGraph& graph = g.graph;
    ASSERT_EQ(graph.cells(), g.cells.complex.cells.size());
    std::vector<int> listed(graph.links().size(), 0);
    for (CellId c(0u); c.index() < graph.cells(); ++c.value) {
      for (const std::uint32_t l : graph.links_of(c)) {
        const Link& link = graph.links()[l];
        EXPECT_TRUE(link.below == c || link.above == c);
        EXPECT_EQ(other_end(link, other_end(link, c)), c);
        ++listed[l];
      }
    }
    for (const int times : listed) EXPECT_EQ(times, 2);
  }
}

TEST(CellGraph, LinksAreTheFacetsBetweenCells) {
  for (const SoupFamily& family : degenerate_families()) {
    SCOPED_TRACE(family.name);
    const Graph g = graph_of(family.make(2));
    std::set<CellId> unbounded;
    std::size_t inner = 0, opaque = 0;
    for (FacetId f(0u); f < g.cells.complex.facets.end_id(); ++f.value) {
      const Facet& facet = g.cells.complex.facets[f];
      if (facet.above.valid() && facet.below.valid()) {
        const Link& link = g.graph.links()[inner++];
        EXPECT_EQ(link.below, facet.below);
        EXPECT_EQ(link.above, facet.above);
        EXPECT_EQ(link.winding, g.cover[f].winding);
        EXPECT_GT(link.area, 0);
        opaque += link.opaque();
      } else {
        unbounded.insert(facet.above.valid() ? facet.above : facet.below);
      }
    }
    EXPECT_EQ(inner, g.graph.links().size());
    EXPECT_GT(opaque, 0u);
    for (CellId c(0u); c.index() < g.graph.cells(); ++c.value) {
      EXPECT_EQ(g.graph.unbounded(c), unbounded.contains(c));
    }
  }
}

TEST(CellGraph, VolumesAreThoseOfTheCells) {
  const Graph g = graph_of(noisy_sphere(4000, 0.1, 1));
  for (CellId c(0u); c.index() < g.graph.cells(); ++c.value) {
    if (g.graph.unbounded(c)) continue;
    const double volume = cell_volume(g.cells.complex, c);
    // The sum is one of volumes up to the origin.
    EXPECT_NEAR(g.graph.volume(c), volume, 1e-6 * volume + 0x1p78 * 1e-14);
  }
}

TEST(CellGraph, EveryCellCanBeReachedFromOutside) {
  for (const SoupFamily& family : degenerate_families()) {
    SCOPED_TRACE(family.name);
    const CellGraph graph = graph_of(family.make(3)).graph;
    std::vector<CellId> queue;
    std::vector<char> seen(graph.cells(), 0);
    for (CellId c(0u); c.index() < graph.cells(); ++c.value) {
      if (!graph.unbounded(c)) continue;
      seen[c.index()] = 1;
      queue.push_back(c);
    }
    for (std::size_t i = 0; i < queue.size(); ++i) {
      for (const std::uint32_t l : graph.links_of(queue[i])) {
        const CellId next = other_end(graph.links()[l], queue[i]);
        if (seen[next.index()] != 0) continue;
        seen[next.index()] = 1;
        queue.push_back(next);
      }
    }
    EXPECT_EQ(queue.size(), graph.cells());
  }
}

TEST(CellGraph, ACubeHasOneBoundedCellBehindTwelveTriangles) {
  const Graph g = graph_of(cube());
  std::size_t bounded = 0;
  for (CellId c(0u); c.index() < g.graph.cells(); ++c.value) {
    if (g.graph.unbounded(c)) continue;
    ++bounded;
    EXPECT_EQ(g.graph.links_of(c).size(), 12u);
    for (const std::uint32_t l : g.graph.links_of(c)) {
      const Link& link = g.graph.links()[l];
      EXPECT_TRUE(link.opaque());
      EXPECT_EQ(link.winding, link.below == c ? 1 : -1);
    }
  }
  EXPECT_EQ(bounded, 1u);
}

TEST(CellGraph, WindingsThatAreSetAreThoseOfTheCover) {
  TriangleSoup soup = random_grid_boxes(8, 4, 3);
  append(soup, cube());
  Cells cells = cells_of(soup);
  const auto windings = own_windings(cells.tree->input);
  CoverReport report;
  std::vector<CoverLayer> layers;
  const auto cover = cover_facets(cells.complex, windings, report, nullptr, &layers);
  EXPECT_FALSE(layers.empty());
  const CellGraph expected(cells.complex, cover);
  CellGraph graph(cells.complex, cover, nullptr, layers);
  graph.set_windings(IdVector<TriangleId, std::int32_t>(windings.size(), 0));
  for (const Link& link : graph.links()) EXPECT_EQ(link.winding, 0);
  graph.set_windings(windings);
  for (std::size_t l = 0; l < graph.links().size(); ++l) {
    EXPECT_EQ(graph.links()[l].winding, expected.links()[l].winding);
  }
}

}  // namespace
}  // namespace meshrepair
