// SPDX-License-Identifier: MIT
#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <mesh/edge_table.h>

#include "each_seed.h"
#include "shapes.h"

namespace meshrepair {
namespace {

using testing::Random;

using Ends = std::pair<std::uint32_t, std::uint32_t>;

Ends ends_of(const std::vector<IndexTriangle>& triangles, std::uint32_t side) {
  const std::uint32_t a = side_start(triangles, side);
  const std::uint32_t b = side_start(triangles, next_side(side));
  return {std::min(a, b), std::max(a, b)};
}

std::vector<IndexTriangle> random_triangles(std::uint64_t seed) {
  Random random(seed);
  std::vector<IndexTriangle> triangles(static_cast<std::size_t>(random.integer(0, 60)));
  const std::int32_t points = random.integer(1, 12);
  for (auto& t : triangles) {
    for (auto& corner : t) corner = static_cast<std::uint32_t>(random.integer(0, points - 1));
  }
  return triangles;
}

TEST(EdgeTable, SidesAreWalkedRoundTheTriangle) {
  for (std::uint32_t t = 0; t < 4; ++t) {
    EXPECT_EQ(next_side(3 * t), 3 * t + 1);
    EXPECT_EQ(next_side(3 * t + 1), 3 * t + 2);
    EXPECT_EQ(next_side(3 * t + 2), 3 * t);
  }
}

// Triangles with equal corners included: the table makes no difference between them.
TEST(EdgeTable, EverySideIsUnderItsEdgeOnceInAscendingOrder) {
  for_each_seed(200, [&](std::uint64_t seed) {
    const auto triangles = random_triangles(seed);
    std::map<Ends, std::vector<std::uint32_t>> expected;
    for (std::uint32_t s = 0; s < 3 * triangles.size(); ++s) {
      expected[ends_of(triangles, s)].push_back(s);
    }
    const EdgeTable table(triangles);
    EXPECT_EQ(table.edges(), expected.size());
    auto next = expected.begin();
    table.for_each_edge([&](std::span<const std::uint32_t> sides) {
      ASSERT_NE(next, expected.end());
      EXPECT_EQ(std::vector<std::uint32_t>(sides.begin(), sides.end()), next->second);
      ++next;
    });
    EXPECT_EQ(next, expected.end());
  });
}

TEST(EdgeTable, NoTrianglesHaveNoEdges) {
  const EdgeTable table({});
  EXPECT_EQ(table.edges(), 0u);
  table.for_each_edge([](auto) { ADD_FAILURE(); });
}

TEST(EdgeTable, AClosedSurfaceHasTwoSidesAtEveryEdge) {
  const TriangleSoup soup = testing::torus(12, 7);
  const EdgeTable table(soup.triangles);
  EXPECT_EQ(2 * table.edges(), 3 * soup.triangles.size());
  table.for_each_edge([](std::span<const std::uint32_t> sides) { EXPECT_EQ(sides.size(), 2u); });
}

}  // namespace
}  // namespace meshrepair
