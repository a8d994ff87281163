// SPDX-License-Identifier: MIT
#include "inside/flood.h"

#include <string>

#include <gtest/gtest.h>

#include "degenerate_soups.h"
#include "graphs.h"

namespace meshrepair {
namespace {

using namespace testing;

TEST(Flood, ClosedSurfaceKeepsTheFloodOut) {
  TriangleSoup soup = box({0, 0, 0}, {4, 4, 4});
  append(soup, box({1, 1, 1}, {2, 2, 2}));
  const Graph g = graph_of(soup);
  const std::vector<char> all_empty(g.graph.cells(), 1);
  // Voids are not reached either.
  EXPECT_DOUBLE_EQ(volume_where(g, internal::flood_from_infinity(g.graph, all_empty)), 64);
}

TEST(Flood, OneMissingTriangleLetsTheFloodIn) {
  TriangleSoup soup = sphere(300);
  soup.triangles.pop_back();
  const Graph g = graph_of(soup);
  const std::vector<char> all_empty(g.graph.cells(), 1);
  EXPECT_LT(volume_where(g, internal::flood_from_infinity(g.graph, all_empty)), 0.5);
}

TEST(Flood, CellsThatAreNotEmptyAreInsideUnlessUnbounded) {
  for (const SoupFamily& family : degenerate_families()) {
    SCOPED_TRACE(family.name);
    const Graph g = graph_of(family.make(1));
    const auto inside =
        internal::flood_from_infinity(g.graph, std::vector<char>(g.graph.cells(), 0));
    for (CellId c(0u); c.index() < g.graph.cells(); ++c.value) {
      EXPECT_EQ(inside[c.index()] != 0, !g.graph.unbounded(c));
    }
  }
}

// What is reached has a way in; what is not has none.
TEST(Flood, BorderOfTheInsideIsOpaqueOrNotEmpty) {
  for (const SoupFamily& family : degenerate_families()) {
    SCOPED_TRACE(family.name);
    const Graph g = graph_of(family.make(2));
    Random random(3);
    std::vector<char> empty(g.graph.cells());
    for (char& e : empty) e = random.chance(0.7) ? 1 : 0;
    const auto inside = internal::flood_from_infinity(g.graph, empty);
    for (const Link& link : g.graph.links()) {
      for (const CellId c : {link.below, link.above}) {
        const CellId other = other_end(link, c);
        if (inside[c.index()] == 0 || inside[other.index()] != 0) continue;
        EXPECT_TRUE(link.opaque() || empty[c.index()] == 0);
      }
    }
    for (CellId c(0u); c.index() < g.graph.cells(); ++c.value) {
      if (empty[c.index()] != 0 || g.graph.unbounded(c)) continue;
      EXPECT_EQ(inside[c.index()], 1);
    }
  }
}

}  // namespace
}  // namespace meshrepair
