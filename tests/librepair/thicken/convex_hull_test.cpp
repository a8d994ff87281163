// SPDX-License-Identifier: MIT
#include <vector>

#include <gtest/gtest.h>

#include <exact/double_predicates.h>

#include "complexes.h"
#include "random_geometry.h"
#include "thicken/hull_walls.h"

namespace meshrepair::internal {
namespace {

using namespace testing;

TriangleSoup hull_of(const std::vector<Vec3d>& points) { return {points, convex_hull(points)}; }

void expect_hull(const std::vector<Vec3d>& points) {
  const TriangleSoup hull = hull_of(points);
  const Topology topology = examine_topology(hull.triangles, hull.points.size());
  EXPECT_TRUE(topology.closed());
  EXPECT_TRUE(topology.manifold());
  EXPECT_TRUE(topology.oriented());
  for (const auto& [a, b, c] : hull.triangles) {
    EXPECT_GE(projection_axis(points[a], points[b], points[c]), 0);
    for (const Vec3d& p : points) EXPECT_LE(orientation(points[a], points[b], points[c], p), 0);
  }
}

TEST(ConvexHull, HullOfRandomPointsIsConvexAndClosed) {
  Random random(1);
  for (int i = 0; i < 50; ++i) {
    std::vector<Vec3d> points;
    for (int k = random.integer(4, 40); k > 0; --k) {
      points.emplace_back(random.real(-1, 1), random.real(-1, 1), random.real(-1, 1));
    }
    expect_hull(points);
  }
}

// Many in one plane, in one line, and in one place.
TEST(ConvexHull, HullOfASmallGridIsConvexAndClosed) {
  Random random(2);
  for (int i = 0; i < 300; ++i) {
    std::vector<Vec3d> points;
    for (int k = 30; k > 0; --k) {
      points.emplace_back(random.integer(0, 2), random.integer(0, 2), random.integer(0, 2));
    }
    expect_hull(points);
  }
}

TEST(ConvexHull, PointsInAPlaneHaveNoHull) {
  EXPECT_TRUE(convex_hull({}).empty());
  EXPECT_TRUE(hull_of({{1, 2, 3}, {1, 2, 3}}).triangles.empty());
  EXPECT_TRUE(hull_of({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {5, 5, 5}}).triangles.empty());
  EXPECT_TRUE(hull_of({{0, 0, 7}, {1, 0, 7}, {0, 1, 7}, {1, 1, 7}}).triangles.empty());
}

}  // namespace
}  // namespace meshrepair::internal
