// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <mesh/triangulate_polygon.h>

#include "large_polygons.h"
#include "soup_fixtures.h"

namespace meshrepair {
namespace {

std::vector<Triangle> triangulate(const std::vector<Vec3d>& points) {
  std::vector<std::uint32_t> corners(points.size());
  std::iota(corners.begin(), corners.end(), 0u);
  std::vector<Triangle> triangles;
  triangulate_polygon(points, corners, triangles);
  return triangles;
}

Vec3d area_vector_of(const std::vector<Vec3d>& points, const Triangle& t) {
  return (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]);
}

// Sum of the lengths of the area vectors less the length of their sum: 0 when no triangle is turned
// over, so when they cover a plane polygon without overlap.
double overlap(const std::vector<Vec3d>& points, const std::vector<Triangle>& triangles) {
  Vec3d sum = Vec3d::Zero();
  double total = 0;
  for (const Triangle& triangle : triangles) {
    sum += area_vector_of(points, triangle);
    total += area_vector_of(points, triangle).norm();
  }
  return total - sum.norm();
}

TEST(TriangulatePolygon, ConvexPolygonIsTheFanOfItsFirstCorner) {
  std::vector<Vec3d> points;
  points.reserve(6);
  for (int i = 0; i < 6; ++i) points.emplace_back(std::cos(i), 5, std::sin(i));
  EXPECT_EQ(triangulate(points),
            (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}));
}

TEST(TriangulatePolygon, ALineCrossesFewTrianglesOfALargeConvexPolygon) {
  constexpr std::size_t kCorners = 10000;
  std::vector<Vec3d> points;
  points.reserve(kCorners);
  for (std::size_t i = 0; i < kCorners; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / kCorners;
    points.emplace_back(std::cos(angle), std::sin(angle), 0);
  }
  const std::vector<Triangle> triangles = triangulate(points);
  EXPECT_EQ(triangles.size(), kCorners - 2);
  EXPECT_LT(overlap(points, triangles), 1e-9);
  for (const Vec3d& normal : {Vec3d(1, 0.3, 0), Vec3d(-0.2, 1, 0), Vec3d(0.7, 0.7, 0)}) {
    const auto crossed = std::count_if(triangles.begin(), triangles.end(), [&](const Triangle& t) {
      const auto above = std::count_if(
          t.begin(), t.end(), [&](auto corner) { return normal.dot(points[corner]) > 0.1; });
      return above == 1 || above == 2;
    });
    EXPECT_LT(crossed, 60);
  }
}

TEST(TriangulatePolygon, ConcaveQuadIsCutAtItsReflexCorner) {
  const std::vector<Vec3d> arrow = {{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}};
  EXPECT_LT(overlap(arrow, triangulate(arrow)), 1e-12);
  const std::vector<Vec3d> turned = {{4, 0, 7}, {1, 1, 7}, {0, 4, 7}, {0, 0, 7}};
  EXPECT_LT(overlap(turned, triangulate(turned)), 1e-12);
}

TEST(TriangulatePolygon, ConcavePolygonsInAnyPlaneAreCoveredWithoutOverlap) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int round = 0; round < 200; ++round) {
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond(unit(random), unit(random), unit(random), unit(random)).normalized();
    // A comb: teeth that a fan would cross.
    std::vector<Vec3d> points = {turn * Vec3d(0, -1, 0)};
    const int teeth = 1 + round % 20;
    points.push_back(turn * Vec3d(2 * teeth, -1, 0));
    for (int i = 2 * teeth; i >= 0; --i)
      points.push_back(turn * Vec3d(i, i % 2 == 0 ? 5 : 0.5 * unit(random), 0));
    std::rotate(points.begin(), points.begin() + round % static_cast<int>(points.size()),
                points.end());
    const std::vector<Triangle> triangles = triangulate(points);
    EXPECT_EQ(triangles.size(), points.size() - 2);
    EXPECT_LT(overlap(points, triangles), 1e-9) << round;
  }
}

TEST(TriangulatePolygon, HoleOnABridgeIsNotCovered) {
  const std::vector<Vec3d> points = {{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}, {0, 0, 0},
                                     {3, 3, 0}, {3, 6, 0}, {6, 6, 0}, {6, 3, 0}, {3, 3, 0}};
  const std::vector<Triangle> triangles = triangulate(points);
  EXPECT_LT(overlap(points, triangles), 1e-12);
}

TEST(TriangulatePolygon, CornersOnAnEdgeGiveNoTriangleWithoutArea) {
  const std::vector<Vec3d> square = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
  for (const Triangle& triangle : triangulate(square))
    EXPECT_GT(area_vector_of(square, triangle).norm(), 0);
}

TEST(TriangulatePolygon, WhatHasNoEarsIsTheFan) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double huge = std::numeric_limits<double>::max();
  const std::vector<Triangle> fan = {{0, 1, 2}, {0, 2, 3}};
  EXPECT_EQ(triangulate({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}), fan);
  EXPECT_EQ(triangulate({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}), fan);
  EXPECT_EQ(triangulate({{0, 0, 0}, {nan, 0, 0}, {1, 1, 0}, {0, 1, 0}}), fan);
  EXPECT_EQ(triangulate({{0, 0, 0}, {huge, 0, 0}, {-huge, huge, 0}, {0, 1, 0}}), fan);
  EXPECT_EQ(triangulate({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}), fan);
}

TEST(TriangulatePolygon, LargeConcavePolygonIsCoveredWithoutOverlap) {
  const std::vector<Vec3d> points = testing::koch_curve(3, 6);
  ASSERT_GT(points.size(), 10000u);
  const std::vector<Triangle> triangles = triangulate(points);
  EXPECT_EQ(triangles.size(), points.size() - 2);
  EXPECT_LT(overlap(points, triangles), 1e-9);
}

TEST(TriangulatePolygon, LargePolygonThatCrossesItselfOverlapsLittle) {
  std::vector<Vec3d> points = testing::koch_curve(3, 6);
  std::swap(points[5000], points[5001]);
  const std::vector<Triangle> triangles = triangulate(points);
  EXPECT_EQ(triangles.size(), points.size() - 2);
  EXPECT_LT(overlap(points, triangles), 0.1);
}

TEST(TriangulatePolygon, ManyCornersTakeNoQuadraticTime) {
  std::vector<Vec3d> points;
  points.reserve(200000);
  for (int i = 0; i < 200000; ++i) points.emplace_back(i, i % 2, 0);
  EXPECT_EQ(triangulate(points).size(), points.size() - 2);
}

}  // namespace
}  // namespace meshrepair
