// SPDX-License-Identifier: MIT
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <mesh/topology.h>

#include "shapes.h"

namespace meshrepair {
namespace {

using namespace testing;

Topology examine(const TriangleSoup& soup) {
  return examine_topology(soup.triangles, soup.points.size());
}

void expect_solid(const Topology& t) {
  EXPECT_TRUE(t.closed());
  EXPECT_TRUE(t.manifold());
  EXPECT_TRUE(t.oriented());
}

TEST(Topology, ClosedShapesAreSolid) {
  for (const TriangleSoup& soup : {cube(), sphere(500), torus(20, 10)}) {
    const Topology t = examine(soup);
    expect_solid(t);
    EXPECT_EQ(t.parts, 1u);
    EXPECT_EQ(2 * t.edges, 3 * t.triangles);
  }
}

TEST(Topology, NothingIsNotClosed) {
  const Topology t = examine(TriangleSoup{});
  EXPECT_FALSE(t.closed());
  EXPECT_EQ(t.parts, 0u);
  EXPECT_EQ(t.edges, 0u);
}

TEST(Topology, AMissingTriangleOpensThreeEdges) {
  TriangleSoup soup = sphere(200);
  soup.triangles.pop_back();
  const Topology t = examine(soup);
  EXPECT_FALSE(t.closed());
  EXPECT_EQ(t.open_edges, 3u);
  EXPECT_TRUE(t.manifold());
  EXPECT_TRUE(t.oriented());
}

TEST(Topology, AFlippedTriangleDisagreesAtThreeEdges) {
  TriangleSoup soup = cube();
  std::swap(soup.triangles[3][0], soup.triangles[3][1]);
  const Topology t = examine(soup);
  EXPECT_EQ(t.inconsistent_edges, 3u);
  EXPECT_FALSE(t.oriented());
  EXPECT_TRUE(t.closed());
  EXPECT_TRUE(t.manifold());
}

TEST(Topology, ASurfaceInsideOutIsConsistent) { expect_solid(examine(flipped(torus(9, 9)))); }

TEST(Topology, TwoCubesThatShareAnEdgeAreNotManifold) {
  TriangleSoup soup = cube();
  // Points 1, 3, 5, 7 have x = 1. The second cube's edge from (1, 1, 0) to (1, 1, 1) is that of the
  // first.
  TriangleSoup second = box({1, 1, 0}, {2, 2, 1});
  for (auto& t : second.triangles) {
    for (auto& corner : t) corner = corner == 0 ? 3 : corner == 4 ? 7 : corner + 8;
  }
  soup.points.insert(soup.points.end(), second.points.begin(), second.points.end());
  soup.triangles.insert(soup.triangles.end(), second.triangles.begin(), second.triangles.end());
  const Topology t = examine(soup);
  EXPECT_EQ(t.nonmanifold_edges, 1u);
  EXPECT_EQ(t.nonmanifold_vertices, 0u);  // the cubes share an edge at its ends
  EXPECT_EQ(t.parts, 1u);
  EXPECT_TRUE(t.closed());
  EXPECT_FALSE(t.manifold());
}

TEST(Topology, TwoCubesThatShareAVertexAreNotManifold) {
  TriangleSoup soup = cube();
  TriangleSoup second = box({1, 1, 1}, {2, 2, 2});
  for (auto& t : second.triangles) {
    for (auto& corner : t) corner = corner == 0 ? 7 : corner + 8;
  }
  soup.points.insert(soup.points.end(), second.points.begin(), second.points.end());
  soup.triangles.insert(soup.triangles.end(), second.triangles.begin(), second.triangles.end());
  const Topology t = examine(soup);
  EXPECT_EQ(t.nonmanifold_edges, 0u);
  EXPECT_EQ(t.nonmanifold_vertices, 1u);
  EXPECT_EQ(t.parts, 2u);
  EXPECT_FALSE(t.manifold());
}

// Points of equal place and different index are different points.
TEST(Topology, CoordinatesPlayNoPart) {
  TriangleSoup soup = cube();
  append(soup, cube());
  const Topology t = examine(soup);
  expect_solid(t);
  EXPECT_EQ(t.parts, 2u);
}

TEST(Topology, AVertexOfManyBordersCountsOnce) {
  TriangleSoup bow;  // three triangles around point 0 that share nothing else
  bow.points.resize(7, Vec3d::Zero());
  bow.triangles = {{0, 1, 2}, {0, 3, 4}, {0, 5, 6}};
  const Topology t = examine(bow);
  EXPECT_EQ(t.nonmanifold_vertices, 1u);
  EXPECT_EQ(t.parts, 3u);
}

TEST(Topology, RepeatedCornersAreNotManifold) {
  TriangleSoup soup = cube();
  soup.triangles.push_back({2, 2, 5});
  const Topology t = examine(soup);
  EXPECT_EQ(t.repeated_corners, 1u);
  EXPECT_FALSE(t.manifold());
}

TEST(Topology, AMoebiusStripCannotBeOriented) {
  TriangleSoup strip;
  const std::uint32_t n = 7;
  strip.points.resize(std::size_t{2} * n, Vec3d::Zero());
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t a = 2 * i, b = 2 * i + 1;
    const bool last = i + 1 == n;
    const std::uint32_t c = last ? 1 : a + 2, d = last ? 0 : b + 2;
    strip.triangles.push_back({a, c, b});
    strip.triangles.push_back({b, c, d});
  }
  const Topology t = examine(strip);
  EXPECT_EQ(t.nonmanifold_edges, 0u);
  EXPECT_EQ(t.open_edges, 2u * n);
  EXPECT_EQ(t.inconsistent_edges, 1u);
}

TEST(Topology, PlacesAreWhereTheCountsComeFrom) {
  TriangleSoup soup = cube();
  append(soup, cube());
  std::swap(soup.triangles[3][1], soup.triangles[3][2]);
  soup.triangles.erase(soup.triangles.begin() + 12);
  soup.triangles.push_back({0, 1, 9});
  TopologyPlaces places;
  const Topology t = examine_topology(soup.triangles, soup.points.size(), &places);
  EXPECT_EQ(places.open_sides.size(), t.open_edges);
  EXPECT_EQ(places.inconsistent_sides.size(), 2 * t.inconsistent_edges);
  EXPECT_EQ(places.nonmanifold_sides.size(), 3 * t.nonmanifold_edges);
  EXPECT_EQ(places.nonmanifold_vertices.size(), t.nonmanifold_vertices);
  EXPECT_GT(t.inconsistent_edges * t.nonmanifold_edges * t.nonmanifold_vertices, 0u);
  ASSERT_EQ(places.parts.size(), soup.triangles.size());
  EXPECT_EQ(places.parts[0], 0u);
  EXPECT_EQ(places.parts[12], 1u);
  EXPECT_EQ(places.parts.back(), 0u);
  EXPECT_EQ(t.parts, 2u);
}

TEST(Volume, IsExactForBoxesWhereverTheyAre) {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const Vec3d low(random.integer(-1000, 1000), random.integer(-1000, 1000),
                    random.integer(-1000, 1000));
    const Vec3d size(random.integer(1, 50), random.integer(1, 50), random.integer(1, 50));
    const TriangleSoup soup = box(low, low + size);
    EXPECT_DOUBLE_EQ(signed_volume(soup), size.prod());
    EXPECT_DOUBLE_EQ(signed_volume(flipped(soup)), -size.prod());
    EXPECT_DOUBLE_EQ(surface_area(soup),
                     2 * (size.x() * size.y() + size.y() * size.z() + size.z() * size.x()));
  }
}

TEST(Volume, OfNothingIsNothing) {
  EXPECT_EQ(signed_volume({}), 0);
  EXPECT_EQ(surface_area({}), 0);
}

TEST(Volume, OfAFineSphereIsThatOfTheBall) {
  const TriangleSoup ball = sphere(200000, 2, {10, 20, 30});
  EXPECT_NEAR(signed_volume(ball), 4 * std::numbers::pi / 3 * 8, 1e-2);
  EXPECT_NEAR(surface_area(ball), 4 * std::numbers::pi * 4, 1e-2);
}

}  // namespace
}  // namespace meshrepair
