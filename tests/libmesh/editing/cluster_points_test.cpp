// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <mesh/cluster_points.h>

#include "shapes.h"

namespace meshrepair {
namespace {

std::vector<char> none_of(const TriangleSoup& soup) {
  return std::vector<char>(soup.triangles.size(), 0);
}

TEST(ClusterPoints, LeavesNoMoreTrianglesThanAskedForAndNotMuchFewer) {
  const TriangleSoup soup = testing::sphere(40000);
  for (const std::size_t most : {30000u, 5000u, 300u}) {
    const ClusteredSoup few = cluster_points(soup, none_of(soup), most);
    EXPECT_LE(few.soup.triangles.size(), most);
    EXPECT_GE(few.soup.triangles.size(), most / 2);
    EXPECT_EQ(few.source.size(), few.soup.triangles.size());
    EXPECT_TRUE(std::is_sorted(few.source.begin(), few.source.end()));
  }
}

TEST(ClusterPoints, AllPointsArePointsOfTheMesh) {
  const TriangleSoup soup = testing::sphere(5000);
  const ClusteredSoup few = cluster_points(soup, none_of(soup), 500);
  for (const Vec3d& p : few.soup.points) {
    EXPECT_NE(std::find(soup.points.begin(), soup.points.end(), p), soup.points.end());
  }
}

TEST(ClusterPoints, LeavesAMeshThatIsSmallEnoughAsItIs) {
  const TriangleSoup soup = testing::sphere(500);
  const ClusteredSoup same = cluster_points(soup, none_of(soup), soup.triangles.size());
  ASSERT_EQ(same.soup.triangles.size(), soup.triangles.size());
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(same.soup.points[same.soup.triangles[t][k]], soup.points[soup.triangles[t][k]]);
    }
  }
}

TEST(ClusterPoints, TrianglesThatAreFixedStayWhereTheyAre) {
  const TriangleSoup soup = testing::sphere(5000);
  std::vector<char> fixed = none_of(soup);
  for (std::size_t t = 0; t < 100; ++t) fixed[7 * t] = 1;
  const ClusteredSoup few = cluster_points(soup, fixed, 300);
  EXPECT_LE(few.soup.triangles.size(), 400u);
  std::size_t found = 0;
  for (std::size_t i = 0; i < few.source.size(); ++i) {
    const std::uint32_t t = few.source[i];
    if (fixed[t] == 0) continue;
    ++found;
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(few.soup.points[few.soup.triangles[i][k]], soup.points[soup.triangles[t][k]]);
    }
  }
  EXPECT_EQ(found, 100u);
}

// All corners are fixed, so cells change nothing.
TEST(ClusterPoints, LeavesEverySoManyWhereCellsDoNotHelp) {
  TriangleSoup soup = testing::sphere(2000);
  const std::size_t count = soup.triangles.size();
  soup.triangles.insert(soup.triangles.end(), soup.triangles.begin(), soup.triangles.end());
  for (std::size_t t = count; t < soup.triangles.size(); ++t) {
    std::swap(soup.triangles[t][0], soup.triangles[t][1]);
  }
  std::vector<char> fixed = none_of(soup);
  std::fill(fixed.begin(), fixed.begin() + static_cast<std::ptrdiff_t>(count), 1);
  const ClusteredSoup few = cluster_points(soup, fixed, 50);
  EXPECT_EQ(few.soup.triangles.size(), count + 50);
}

TEST(ClusterPoints, WhatIsNotFiniteGoes) {
  TriangleSoup soup = testing::sphere(100);
  soup.points[soup.triangles[3][1]].x() = std::numeric_limits<double>::quiet_NaN();
  const ClusteredSoup few = cluster_points(soup, none_of(soup), 1000);
  EXPECT_LT(few.soup.triangles.size(), soup.triangles.size());
  for (const Vec3d& p : few.soup.points) EXPECT_TRUE(p.allFinite());
}

TEST(ClusterPoints, WorksAtTheEdgeOfDoubles) {
  const TriangleSoup soup = testing::scaled(testing::sphere(2000), 1e308);
  const ClusteredSoup few = cluster_points(soup, none_of(soup), 200);
  EXPECT_LE(few.soup.triangles.size(), 200u);
  EXPECT_GE(few.soup.triangles.size(), 100u);
}

TEST(ClusterPoints, OfNothingIsNothing) {
  EXPECT_TRUE(cluster_points({}, {}, 10).soup.triangles.empty());
  const TriangleSoup soup = testing::sphere(100);
  EXPECT_TRUE(cluster_points(soup, none_of(soup), 0).soup.triangles.empty());
}

}  // namespace
}  // namespace meshrepair
