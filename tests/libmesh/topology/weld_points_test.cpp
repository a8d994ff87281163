// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <mesh/weld_points.h>

namespace meshrepair {
namespace {

TEST(WeldPoints, NumbersAreGivenInOrderOfFirstAppearance) {
  std::vector<Vec3d> points;
  PointWelder welder(points);
  EXPECT_EQ(welder.index_of({1, 2, 3}), 0u);
  EXPECT_EQ(welder.index_of({3, 2, 1}), 1u);
  EXPECT_EQ(welder.index_of({1, 2, 3}), 0u);
  EXPECT_EQ(welder.index_of({2, 1, 3}), 2u);
  EXPECT_EQ(points, (std::vector<Vec3d>{{1, 2, 3}, {3, 2, 1}, {2, 1, 3}}));
}

TEST(WeldPoints, MinusZeroIsZero) {
  std::vector<Vec3d> points;
  PointWelder welder(points);
  EXPECT_EQ(welder.index_of({-0.0, 0, -0.0}), 0u);
  EXPECT_EQ(welder.index_of({0, -0.0, 0}), 0u);
  for (const double value : points[0]) EXPECT_FALSE(std::signbit(value));
}

TEST(WeldPoints, PointsThatDifferInTheLastBitStayApart) {
  std::vector<Vec3d> points;
  PointWelder welder(points);
  EXPECT_EQ(welder.index_of({1, 0, 0}), 0u);
  EXPECT_EQ(welder.index_of({std::nextafter(1.0, 2.0), 0, 0}), 1u);
  EXPECT_EQ(welder.index_of({1, 0, std::numeric_limits<double>::denorm_min()}), 2u);
}

TEST(WeldPoints, FirstInPlaceGoesOnFromAnotherList) {
  const std::vector<Vec3d> before = {{1, 0, 0}, {-0.0, 0, 0}, {1, 0, 0}};
  const std::vector<Vec3d> points = {{2, 0, 0}, {0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  EXPECT_EQ(first_in_place(before, points), (std::vector<std::uint32_t>{3, 1, 0, 3}));
  EXPECT_EQ(first_in_place({}, points), first_in_place(points));
  EXPECT_EQ(first_in_place(points), (std::vector<std::uint32_t>{0, 1, 2, 0}));
  EXPECT_TRUE(first_in_place(before, {}).empty());
}

// A list with points of few places, NaN and both zeros among them.
std::vector<Vec3d> random_points(std::mt19937& random, std::size_t count, int places) {
  const auto coordinate = [&] {
    const auto n = static_cast<int>(random() % static_cast<unsigned>(places));
    if (n == 1) return std::numeric_limits<double>::quiet_NaN();
    return n == 2 ? -0.0 : n - 3.0;
  };
  std::vector<Vec3d> points;
  for (std::size_t p = 0; p < count; ++p) {
    points.emplace_back(coordinate(), coordinate(), coordinate());
  }
  return points;
}

// Some points moved, dropped, or new.
std::vector<Vec3d> changed(const std::vector<Vec3d>& points, std::mt19937& random,
                           std::size_t rarity, int places) {
  std::vector<Vec3d> result;
  for (const Vec3d& p : points) {
    const std::size_t chance = random() % rarity;
    const Vec3d fresh = random_points(random, 1, places)[0];
    if (chance != 1) result.push_back(chance == 0 ? fresh : p);
    if (chance == 2) result.push_back(fresh);
    if (chance == 3) result.insert(result.end(), 2, p);
  }
  return result;
}

TEST(WeldPoints, FirstInPlaceOfKnownListsIsThatOfAnyLists) {
  std::mt19937 random(7);
  for (int round = 0; round < 400; ++round) {
    const int places = round % 2 == 0 ? 6 : 1000;
    const std::vector<Vec3d> before = random_points(random, random() % 500, places);
    const std::vector<Vec3d> points = round % 17 == 0
                                          ? random_points(random, random() % 500, places)
                                          : changed(before, random, 5 + random() % 200, places);
    EXPECT_EQ(first_in_place(before, first_in_place(before), points),
              first_in_place(before, points))
        << "round " << round;
  }
}

// The gap is longer than what is looked ahead.
TEST(WeldPoints, FirstInPlaceFindsPointsBeyondALongGap) {
  std::mt19937 random(8);
  const std::vector<Vec3d> before = random_points(random, 5000, 1000);
  std::vector<Vec3d> points = before;
  points.erase(points.begin() + 100, points.begin() + 300);
  EXPECT_EQ(first_in_place(before, first_in_place(before), points), first_in_place(before, points));
  EXPECT_EQ(first_in_place(points, first_in_place(points), before), first_in_place(points, before));
}

TEST(WeldPoints, NanIsEqualToItself) {
  std::vector<Vec3d> points;
  PointWelder welder(points);
  EXPECT_EQ(welder.index_of({std::nan(""), 0, INFINITY}), 0u);
  EXPECT_EQ(welder.index_of({std::nan(""), 0, INFINITY}), 0u);
  EXPECT_EQ(welder.index_of({std::nan(""), 0, -INFINITY}), 1u);
}

// Grows many times over, from an expectation that is far too small.
TEST(WeldPoints, ManyPointsKeepTheirNumbers) {
  std::vector<Vec3d> points;
  PointWelder welder(points, 1);
  std::mt19937 random(7);
  std::vector<Vec3d> grid;
  for (int x = 0; x < 40; ++x) {
    for (int y = 0; y < 40; ++y) {
      for (int z = 0; z < 40; ++z) grid.emplace_back(x, y * 0x1p-20, -z);
    }
  }
  std::shuffle(grid.begin(), grid.end(), random);
  for (std::uint32_t i = 0; i < grid.size(); ++i) ASSERT_EQ(welder.index_of(grid[i]), i);
  for (std::uint32_t i = 0; i < grid.size(); ++i) ASSERT_EQ(welder.index_of(grid[i]), i);
  EXPECT_EQ(points.size(), grid.size());
}

}  // namespace
}  // namespace meshrepair
