// SPDX-License-Identifier: MIT
#include "holes/boundary_loops.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include <repair/orient_parts.h>

#include "shapes.h"
#include "trees.h"

namespace meshrepair::internal {
namespace {

using namespace testing;

// Each loop as a set of positions in the list of points given.
std::multiset<std::set<std::uint32_t>> loops_of(const TriangleSoup& soup) {
  const CleanSoup clean = cleaned(soup);
  const auto triangles = index_triangles(clean);
  const BoundaryLoops loops = find_boundary_loops(clean, triangles, EdgeTable(triangles), nullptr);
  EXPECT_EQ(loops.stray_edges, 0u);
  std::multiset<std::set<std::uint32_t>> found;
  for (std::size_t l = 0; l < loops.loops(); ++l) {
    std::set<std::uint32_t> points;
    for (const std::uint32_t p : loops.points_of(l)) {
      const auto& position = clean.points[PointId(p)];
      const auto at = std::find(soup.points.begin(), soup.points.end(), position);
      points.insert(static_cast<std::uint32_t>(at - soup.points.begin()));
    }
    found.insert(points);
  }
  return found;
}

TEST(BoundaryLoops, ACrackIsALoopThoughASliverEndsInIt) {
  // The sheet below has the edge 1 2, the one above the point 0 beside it and a sliver at each end.
  TriangleSoup soup;
  soup.points = {{2, 0.5, 0},      {0, 0, 0},        {4, 0, 0}, {2, -3, 0},
                 {1, 0.28, 0.005}, {3, 0.28, 0.005}, {2, 3, 0}};
  soup.triangles = {{1, 3, 2}, {1, 0, 4}, {0, 2, 5}, {4, 0, 6}, {0, 5, 6}};
  EXPECT_EQ(loops_of(soup),
            (std::multiset<std::set<std::uint32_t>>{{0, 1, 2}, {1, 2, 3, 4, 5, 6}}));
}

TEST(BoundaryLoops, SheetsThatTouchInAPointHaveALoopEach) {
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}};
  soup.triangles = {{0, 1, 2}, {0, 3, 4}};
  EXPECT_EQ(loops_of(soup), (std::multiset<std::set<std::uint32_t>>{{0, 1, 2}, {0, 3, 4}}));
}

// Three triangles at an edge, one of which is there twice: they may bound two solids.
TEST(BoundaryLoops, AnEdgeIsNoBorderWhereLayersAreEven) {
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, -1}};
  soup.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  CleanSoup clean = cleaned(soup);
  const auto triangles = index_triangles(clean);
  for (const std::int32_t layers : {1, 2}) {
    clean.triangles[TriangleId(0u)].layers = layers;
    const auto loops = find_boundary_loops(clean, triangles, EdgeTable(triangles), nullptr);
    EXPECT_EQ(loops.edges.size(), layers == 1 ? 7u : 6u);
  }
}

}  // namespace
}  // namespace meshrepair::internal
