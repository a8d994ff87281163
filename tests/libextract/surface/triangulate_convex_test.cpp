// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include <base/error.h>
#include <mesh/topology.h>

#include "each_seed.h"
#include "random_geometry.h"
#include "surface/region_triangulator.h"

namespace meshrepair {
namespace {

using testing::Random;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

struct IntegerPoint {
  std::int64_t x = 0, y = 0;
  auto operator<=>(const IntegerPoint&) const = default;
};

std::int64_t twice_area(const IntegerPoint& a, const IntegerPoint& b, const IntegerPoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Counter-clockwise, without straight vertices.
std::vector<IntegerPoint> convex_hull(std::vector<IntegerPoint> points) {
  std::sort(points.begin(), points.end());
  std::vector<IntegerPoint> hull;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t base = hull.size();
    for (const IntegerPoint& p : points) {
      while (hull.size() >= base + 2 &&
             twice_area(hull[hull.size() - 2], hull[hull.size() - 1], p) <= 0) {
        hull.pop_back();
      }
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

// The lattice points inside the sides, each with some probability, all coordinates multiplied
// before so that there are some.
std::vector<IntegerPoint> with_straight_vertices(const std::vector<IntegerPoint>& hull,
                                                 std::int64_t parts, double share, Random& random) {
  std::vector<IntegerPoint> polygon;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const IntegerPoint& a = hull[i];
    const IntegerPoint& b = hull[(i + 1) % hull.size()];
    polygon.push_back({a.x * parts, a.y * parts});
    const bool this_side = random.chance(0.6);
    for (std::int64_t k = 1; k < parts; ++k) {
      if (!this_side || !random.chance(share)) continue;
      polygon.push_back({a.x * (parts - k) + b.x * k, a.y * (parts - k) + b.y * k});
    }
  }
  return polygon;
}

void expect_triangulation(const std::vector<IntegerPoint>& polygon) {
  const std::size_t n = polygon.size();
  std::vector<internal::PolygonCorner> corners;
  std::int64_t whole = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const IntegerPoint& before = polygon[(i + n - 1) % n];
    const IntegerPoint& after = polygon[(i + 1) % n];
    corners.push_back({{static_cast<double>(polygon[i].x), static_cast<double>(polygon[i].y), 0},
                       twice_area(before, polygon[i], after) == 0});
    whole += twice_area(polygon[0], polygon[i], after);
  }
  Triangles triangles = {{7, 7, 7}};  // what is there stays
  internal::triangulate_convex(corners, triangles);
  ASSERT_EQ(triangles.size(), n - 1);
  EXPECT_EQ(triangles.front(), (std::array<std::uint32_t, 3>{7, 7, 7}));
  triangles.erase(triangles.begin());
  std::int64_t sum = 0;
  for (const auto& t : triangles) {
    for (const std::uint32_t corner : t) ASSERT_LT(corner, n);
    const std::int64_t area = twice_area(polygon[t[0]], polygon[t[1]], polygon[t[2]]);
    ASSERT_GT(area, 0);
    sum += area;
  }
  EXPECT_EQ(sum, whole);
  // Its border is the polygon, so it has no vertex in the middle of another triangle's edge.
  const Topology topology = examine_topology(triangles, n);
  EXPECT_EQ(topology.open_edges, n);
  EXPECT_TRUE(topology.manifold() && topology.oriented());
  EXPECT_EQ(topology.parts, 1u);
}

TEST(TriangulateConvex, RandomPolygonsAreCoveredWithoutDegeneratePieces) {
  for_each_seed(4000, [&](std::uint64_t seed) {
    Random random(seed);
    const std::int32_t size = random.integer(2, 60);
    std::vector<IntegerPoint> points(static_cast<std::size_t>(random.integer(3, 40)));
    for (IntegerPoint& p : points) p = {random.integer(0, size), random.integer(0, size)};
    const auto hull = convex_hull(points);
    if (hull.size() < 3) return;
    expect_triangulation(with_straight_vertices(
        hull, random.integer(1, 9), random.chance(0.3) ? 1 : random.real(0, 1), random));
  });
}

TEST(TriangulateConvex, TriangleWithFullSidesHasNoDegeneratePiece) {
  Random random(1);
  for (std::int64_t parts = 1; parts < 30; ++parts) {
    std::vector<IntegerPoint> polygon;
    const std::array<IntegerPoint, 3> corner = {{{0, 0}, {1, 0}, {0, 1}}};
    for (std::size_t i = 0; i < 3; ++i) {
      const IntegerPoint& a = corner[i];
      const IntegerPoint& b = corner[(i + 1) % 3];
      for (std::int64_t k = 0; k < parts; ++k) {
        polygon.push_back({a.x * (parts - k) + b.x * k, a.y * (parts - k) + b.y * k});
      }
    }
    // Wherever the polygon starts.
    for (std::size_t start = 0; start < polygon.size(); ++start) {
      SCOPED_TRACE(start);
      expect_triangulation(polygon);
      std::rotate(polygon.begin(), polygon.begin() + 1, polygon.end());
    }
  }
}

TEST(TriangulateConvex, ATriangleIsItself) {
  expect_triangulation({{0, 0}, {5, 1}, {2, 4}});
  Triangles triangles;
  const std::vector<internal::PolygonCorner> corners(3);
  internal::triangulate_convex(corners, triangles);
  EXPECT_EQ(triangles, (Triangles{{0, 1, 2}}));
}

TEST(TriangulateConvex, FewerThanThreeCornersAreOurBug) {
  Triangles triangles;
  const std::vector<internal::PolygonCorner> corners(2);
  EXPECT_THROW(internal::triangulate_convex(corners, triangles), InternalError);
}

}  // namespace
}  // namespace meshrepair
