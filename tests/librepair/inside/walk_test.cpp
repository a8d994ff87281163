// SPDX-License-Identifier: MIT
#include <string>

#include <gtest/gtest.h>

#include <repair/solidity.h>
#include <repair/walk.h>

#include "degenerate_soups.h"
#include "each_seed.h"
#include "graphs.h"

namespace meshrepair {
namespace {

using namespace testing;

std::vector<char> where_equal(const std::vector<std::int32_t>& values, std::int32_t value) {
  std::vector<char> marked;
  for (const std::int32_t v : values) marked.push_back(v == value ? 1 : 0);
  return marked;
}

TEST(Walk, ValuesOutsideAreZero) {
  for (const SoupFamily& family : degenerate_families()) {
    SCOPED_TRACE(family.name);
    const Graph g = graph_of(family.make(1));
    const Walk parity = walk_parity(g.graph);
    const Walk winding = walk_winding(g.graph);
    for (CellId c(0u); c.index() < g.graph.cells(); ++c.value) {
      if (!g.graph.unbounded(c)) continue;
      EXPECT_EQ(parity.value[c.index()], 0);
      EXPECT_EQ(winding.value[c.index()], 0);
    }
  }
}

TEST(Walk, OverlappingBoxesHaveWindingTwoWhereBothAre) {
  TriangleSoup soup = box({0, 0, 0}, {3, 2, 2});
  append(soup, box({2, 0.5, 0.25}, {5, 1.5, 1.25}));
  const Graph g = graph_of(soup);
  const Walk winding = walk_winding(g.graph);
  ASSERT_TRUE(winding.consistent());
  EXPECT_DOUBLE_EQ(volume_where(g, where_equal(winding.value, 2)), 1);
  EXPECT_DOUBLE_EQ(volume_where(g, where_equal(winding.value, 1)), 13);
  const Walk parity = walk_parity(g.graph);
  ASSERT_TRUE(parity.consistent());
  EXPECT_DOUBLE_EQ(volume_where(g, where_equal(parity.value, 1)), 13);
}

TEST(Walk, NestedBoxesCountUpAndInsideOutOnesDown) {
  TriangleSoup soup = box({0, 0, 0}, {5, 5, 5});
  append(soup, flipped(box({1, 1, 1}, {4, 4, 4})));
  append(soup, box({2, 2, 2}, {3, 3, 3}));
  const Graph g = graph_of(soup);
  const Walk winding = walk_winding(g.graph);
  ASSERT_TRUE(winding.consistent());
  EXPECT_DOUBLE_EQ(volume_where(g, where_equal(winding.value, 1)), 125 - 27 + 1);
  const Graph out = graph_of(flipped(box({0, 0, 0}, {2, 2, 2})));
  EXPECT_DOUBLE_EQ(volume_where(out, where_equal(walk_winding(out.graph).value, -1)), 8);
}

// Parity does not look at orientation, and closed surfaces never contradict it, wherever they
// cross.
TEST(Walk, ClosedSurfacesAreConsistent) {
  for_each_seed(10, [&](std::uint64_t seed) {
    const TriangleSoup soup = random_cubes(8, seed);
    const Graph g = graph_of(soup);
    EXPECT_TRUE(walk_winding(g.graph).consistent());
    EXPECT_TRUE(walk_parity(g.graph).consistent());
    const Graph mixed = graph_of(with_some_flipped(soup, 0.3, seed));
    EXPECT_TRUE(walk_parity(mixed.graph).consistent());
    EXPECT_FALSE(walk_winding(mixed.graph).consistent());
  });
}

// On a grid faces coincide; winding is additive all the same, parity is not.
TEST(Walk, WindingOfGridBoxesIsConsistent) {
  for_each_seed(20, [&](std::uint64_t seed) {
    const Graph g = graph_of(tetrahedra_soup(8, seed));
    const Walk winding = walk_winding(g.graph);
    // Equal triangles of two tetrahedra are one triangle, which loses one of two windings.
    if (CleanReport r;
        (void)clean_soup(tetrahedra_soup(8, seed), r), r.duplicates + r.opposite_duplicates > 0) {
      return;
    }
    EXPECT_TRUE(winding.consistent());
  });
}

TEST(Walk, AMissingTriangleIsAContradiction) {
  TriangleSoup soup = sphere(200);
  soup.triangles.resize(soup.triangles.size() - 5);
  const Graph g = graph_of(soup);
  EXPECT_FALSE(walk_parity(g.graph).consistent());
  EXPECT_FALSE(walk_winding(g.graph).consistent());
}

// The contract: where the walk is consistent it is the optimum.
TEST(Walk, ConsistentWalksAreTheOptima) {
  for_each_seed(4, [&](std::uint64_t seed) {
    const Graph g = graph_of(random_cubes(5, seed));
    SolveOptions options;
    options.tolerance = 1e-12;
    SolveReport report;
    const Walk parity = walk_parity(g.graph);
    const Walk winding = walk_winding(g.graph);
    const auto s = solve_solidity(g.graph, options, report);
    const auto w = solve_winding(g.graph, options, report);
    for (std::size_t c = 0; c < g.graph.cells(); ++c) {
      EXPECT_NEAR(s[c], 2 * parity.value[c] - 1, 1e-4);
      EXPECT_NEAR(w[c], winding.value[c], 1e-4);
    }
  });
}

}  // namespace
}  // namespace meshrepair
