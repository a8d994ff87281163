// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <mesh/split_edges.h>
#include <mesh/topology.h>

#include "shapes.h"

namespace meshrepair {
namespace {

constexpr std::size_t kMany = 1'000'000;

double longest_edge(const TriangleSoup& soup) {
  double longest = 0;
  for (const auto& t : soup.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      longest = std::max(longest, (soup.points[t[k]] - soup.points[t[(k + 1) % 3]]).norm());
    }
  }
  return longest;
}

double area_of(const TriangleSoup& soup) {
  double area = 0;
  for (const auto& [a, b, c] : soup.triangles) {
    area += 0.5 * (soup.points[b] - soup.points[a]).cross(soup.points[c] - soup.points[a]).norm();
  }
  return area;
}

TEST(SplitEdges, LeavesNoLongerEdge) {
  const TriangleSoup box = testing::box({0, 0, 0}, {1, 2, 7});
  for (const double length : {3.0, 0.5, 0.11}) {
    EXPECT_LE(longest_edge(split_edges(box, length, kMany)), length);
  }
}

TEST(SplitEdges, KeepsTheSurface) {
  const TriangleSoup box = testing::box({0, 0, 0}, {1, 2, 7});
  const TriangleSoup fine = split_edges(box, 0.2, kMany);
  EXPECT_NEAR(area_of(fine), 46, 1e-9);
  EXPECT_TRUE(std::equal(box.points.begin(), box.points.end(), fine.points.begin()));
  const Topology topology = examine_topology(fine.triangles, fine.points.size());
  EXPECT_TRUE(topology.closed() && topology.manifold() && topology.oriented());
}

TEST(SplitEdges, MakesNoMoreTrianglesThanAllowed) {
  const TriangleSoup box = testing::box({0, 0, 0}, {1, 1, 1});
  const TriangleSoup fine = split_edges(box, 0.001, 1000);
  EXPECT_LE(fine.triangles.size(), 1000u);
  EXPECT_GT(fine.triangles.size(), 100u);
  EXPECT_EQ(split_edges(box, 0.001, 12).triangles, box.triangles);
}

TEST(SplitEdges, LeavesTheRestWhereOneTriangleIsLarge) {
  TriangleSoup soup = testing::sphere(2000);
  testing::append(soup, {{{0, 0, 5}, {9, 0, 5}, {0, 9, 5}}, {{0, 1, 2}}});
  const TriangleSoup fine = split_edges(soup, 1, kMany);
  EXPECT_TRUE(std::equal(soup.triangles.begin(), soup.triangles.end() - 1, fine.triangles.begin()));
  EXPECT_GT(fine.triangles.size(), soup.triangles.size() + 50);
}

TEST(SplitEdges, EndsWhateverTheNumbers) {
  const TriangleSoup huge = {{{1e308, 0, 0}, {-1e308, 0, 0}, {0, 1e308, 1}}, {{0, 1, 2}}};
  EXPECT_EQ(split_edges(huge, 1, kMany).triangles.size(), 1u);
  const TriangleSoup close = {{{1e16, 0, 0}, {1e16 + 2, 0, 0}, {1e16, 2, 0}}, {{0, 1, 2}}};
  EXPECT_LE(split_edges(close, 1e-3, 100).triangles.size(), 100u);
  EXPECT_EQ(split_edges(close, 0, kMany).triangles.size(), 1u);
  EXPECT_TRUE(split_edges({}, 1, kMany).triangles.empty());
}

}  // namespace
}  // namespace meshrepair
