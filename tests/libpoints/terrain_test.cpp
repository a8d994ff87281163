// SPDX-License-Identifier: MIT
#include <cmath>

#include <gtest/gtest.h>

#include <points/terrain.h>

#include "shapes.h"

namespace meshrepair {
namespace {

// The graph of a function over the unit square, on a grid.
template <class Height>
TriangleSoup graph_of(const Height& height) {
  constexpr std::uint32_t kSide = 40;
  TriangleSoup soup;
  for (std::uint32_t x = 0; x <= kSide; ++x) {
    for (std::uint32_t y = 0; y <= kSide; ++y) {
      const double u = static_cast<double>(x) / kSide;
      const double v = static_cast<double>(y) / kSide;
      soup.points.emplace_back(u, v, height(u, v));
    }
  }
  for (std::uint32_t x = 0; x < kSide; ++x) {
    for (std::uint32_t y = 0; y < kSide; ++y) {
      const std::uint32_t a = x * (kSide + 1) + y;
      const std::uint32_t b = a + kSide + 1;
      soup.triangles.push_back({a, b, b + 1});
      soup.triangles.push_back({a, b + 1, a + 1});
    }
  }
  return soup;
}

double rolling_hills(double x, double y) { return 0.1 * std::sin(7 * x) * std::cos(5 * y); }

double lone_hill(double x, double y) {
  return 0.3 * std::exp(-20 * ((x - 0.5) * (x - 0.5) + (y - 0.5) * (y - 0.5)));
}

// The triangles of a surface that lie above a plane.
TriangleSoup above(const TriangleSoup& soup, double height) {
  TriangleSoup part;
  part.points = soup.points;
  for (const auto& t : soup.triangles) {
    if (soup.points[t[0]].z() > height && soup.points[t[1]].z() > height &&
        soup.points[t[2]].z() > height) {
      part.triangles.push_back(t);
    }
  }
  return part;
}

TEST(Terrain, HillsAreATerrainSeenFromAbove) {
  EXPECT_TRUE(is_terrain(graph_of(rolling_hills), 2));
  EXPECT_TRUE(is_terrain(graph_of(lone_hill), 2));
  EXPECT_FALSE(is_terrain(graph_of(rolling_hills), 0));
  EXPECT_FALSE(is_terrain(graph_of(rolling_hills), 1));
}

TEST(Terrain, PlacesAndSizesDoNotMatter) {
  TriangleSoup far = graph_of(rolling_hills);
  for (Vec3d& p : far.points) p = 1e4 * p + Vec3d(5e5, 4e6, 300);
  EXPECT_TRUE(is_terrain(far, 2));
}

TEST(Terrain, PlanesMayBeWalls) {
  EXPECT_FALSE(is_terrain(graph_of([](double, double) { return 0.0; }), 2));
  EXPECT_FALSE(is_terrain(graph_of([](double x, double) { return 0.001 * x; }), 2));
}

TEST(Terrain, WhatIsFlatterThanItsNoiseMayBeAThinPlate) {
  EXPECT_TRUE(is_terrain(graph_of(rolling_hills), 2, 0.1));
  EXPECT_FALSE(is_terrain(graph_of(rolling_hills), 2, 0.3));
}

TEST(Terrain, OneSideOfABodyIsSteepWhereItEnds) {
  EXPECT_FALSE(is_terrain(above(testing::sphere(5000), 0), 2));
  EXPECT_FALSE(is_terrain(above(testing::sphere(5000), 0.4), 2));
  EXPECT_FALSE(is_terrain(above(testing::torus(100, 50), 0.02), 2));
}

TEST(Terrain, TwoSheetsOnEachOtherAreNoTerrain) {
  TriangleSoup two = graph_of(rolling_hills);
  testing::append(two, testing::moved(two, {0, 0, 0.05}));
  EXPECT_FALSE(is_terrain(two, 2));
}

TEST(Terrain, NoTrianglesAreNoTerrain) { EXPECT_FALSE(is_terrain(TriangleSoup(), 2)); }

}  // namespace
}  // namespace meshrepair
