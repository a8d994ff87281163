// SPDX-License-Identifier: MIT
#include "simplify/movable_region.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace meshrepair {
namespace {

using internal::MovableRegion;

// A strip of squares, cut alike; point i is above, length + 1 + i below.
TriangleSoup strip(std::uint32_t length) {
  TriangleSoup soup;
  for (const double y : {1.0, 0.0}) {
    for (std::uint32_t i = 0; i <= length; ++i) soup.points.emplace_back(i, y, 0);
  }
  for (std::uint32_t i = 0; i < length; ++i) {
    const std::uint32_t below = length + 1 + i;
    soup.triangles.push_back({i, below, i + 1});
    soup.triangles.push_back({i + 1, below, below + 1});
  }
  return soup;
}

struct MovableRegionTest : ::testing::Test {
  MovableRegionTest() : soup_(strip(10)), stays_(22, 1), within_(22), source_(20) {
    stays_[5] = 0;
    std::iota(within_.begin(), within_.end(), 0.0);
    std::iota(source_.begin(), source_.end(), 100u);
  }

  TriangleSoup soup_;
  std::vector<char> stays_;
  std::vector<double> within_;
  std::vector<std::uint32_t> source_;
};

TEST_F(MovableRegionTest, HasAllTrianglesOfNeighbours) {
  const MovableRegion region(soup_, stays_, within_, source_);
  const std::set<std::uint32_t> neighbours{4, 5, 6, 15, 16};
  std::vector<std::uint32_t> expected;
  for (std::uint32_t t = 0; t < soup_.triangles.size(); ++t) {
    const auto& corners = soup_.triangles[t];
    if (std::any_of(corners.begin(), corners.end(),
                    [&](std::uint32_t p) { return neighbours.contains(p); })) {
      expected.push_back(t);
    }
  }
  EXPECT_EQ(region.triangles(), expected);
}

TEST_F(MovableRegionTest, NumbersOfTheWholeMeshComeBack) {
  const MovableRegion region(soup_, stays_, within_, source_);
  ASSERT_EQ(region.mesh().triangles.size(), region.triangles().size());
  EXPECT_TRUE(std::is_sorted(region.points().begin(), region.points().end()));
  for (std::uint32_t t = 0; t < region.triangles().size(); ++t) {
    const std::uint32_t whole = region.triangles()[t];
    EXPECT_EQ(region.find(whole), t);
    EXPECT_EQ(region.source()[t], source_[whole]);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(region.points()[region.mesh().triangles[t][k]], soup_.triangles[whole][k]);
    }
  }
  for (std::uint32_t p = 0; p < region.points().size(); ++p) {
    EXPECT_EQ(region.mesh().points[p], soup_.points[region.points()[p]]);
    EXPECT_EQ(region.within()[p], within_[region.points()[p]]);
    EXPECT_EQ(region.stays()[p], stays_[region.points()[p]]);
  }
  EXPECT_FALSE(region.find(0).has_value());
  EXPECT_FALSE(region.find(19).has_value());
}

TEST_F(MovableRegionTest, WhatIsToldToStayIsToldToTheWholeMesh) {
  MovableRegion region(soup_, stays_, within_, source_);
  const auto at = std::find(region.points().begin(), region.points().end(), 5u);
  region.stay(static_cast<std::uint32_t>(at - region.points().begin()));
  region.copy_stays(stays_);
  EXPECT_EQ(stays_, std::vector<char>(22, 1));
}

TEST_F(MovableRegionTest, IsEmptyWhereNothingMoves) {
  stays_[5] = 1;
  const MovableRegion region(soup_, stays_, within_, {});
  EXPECT_TRUE(region.mesh().triangles.empty());
  EXPECT_TRUE(region.mesh().points.empty());
}

}  // namespace
}  // namespace meshrepair
