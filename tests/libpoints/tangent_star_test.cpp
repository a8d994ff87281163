// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "point_stars.h"

namespace meshrepair {
namespace {

const Vec3d kOrigin = {0, 0, 0};
const Vec3d kUp = {0, 0, 1};

std::set<std::uint32_t> neighbours_of(const TangentStar& star) {
  std::set<std::uint32_t> found;
  for (const TangentStar::Corner& corner : star.corners()) found.insert(corner.neighbour);
  return found;
}

void add_hexagon(TangentStar& star) {
  for (std::uint32_t i = 0; i < 6; ++i) {
    const double angle = i * std::numbers::pi / 3;
    star.add(i, {std::cos(angle), std::sin(angle), 0}, 0);
  }
}

TEST(TangentStar, StarInAHexagonHasSixNeighbours) {
  TangentStar star;
  star.begin(kOrigin, kUp, 10);
  add_hexagon(star);
  EXPECT_EQ(neighbours_of(star), (std::set<std::uint32_t>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(star.corners().size(), 6U);
  EXPECT_NEAR(star.squared_radius(), 1.0 / 3, 1e-12);
}

TEST(TangentStar, CornersAreCounterClockwiseAroundTheNormal) {
  for (const Vec3d& normal : {kUp, Vec3d(-kUp), Vec3d(Vec3d(1, -2, 3).normalized())}) {
    TangentStar star;
    star.begin(kOrigin, normal, 10);
    add_hexagon(star);
    const auto& corners = star.corners();
    double area = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const auto& next = corners[(i + 1) % corners.size()];
      area += corners[i].x * next.y - corners[i].y * next.x;
    }
    EXPECT_GT(area, 0);
  }
}

TEST(TangentStar, StarIsOpenWhereNeighboursAreMissing) {
  TangentStar star;
  star.begin(kOrigin, kUp, 1);
  star.add(0, {1, 0, 0}, 0);
  EXPECT_EQ(neighbours_of(star), (std::set<std::uint32_t>{0, TangentStar::kNone}));
}

// A point straight above, and one a little beside it, have bisectors that run between the sheets.
TEST(TangentStar, TheFarSheetOfAPlateDoesNotGetInTheWay) {
  TangentStar star;
  star.begin(kOrigin, kUp, 10);
  add_hexagon(star);
  star.add(100, {0, 0, 3}, 0);
  star.add(101, {0.1, 0.05, 3}, 0);
  EXPECT_EQ(neighbours_of(star), (std::set<std::uint32_t>{0, 1, 2, 3, 4, 5}));
}

TEST(TangentStar, WeightsSettleASquareAlikeForAllItsCorners) {
  const std::array<Vec3d, 4> square = {Vec3d(0, 0, 0), Vec3d(1, 0, 0), Vec3d(1, 1, 0),
                                       Vec3d(0, 1, 0)};
  const std::array<double, 4> weight = {1e-3, 2e-4, 5e-4, 3e-4};
  std::set<std::set<std::uint32_t>> diagonals;
  for (std::uint32_t p = 0; p < 4; ++p) {
    TangentStar star;
    star.begin(square[p], kUp, 10);
    for (std::uint32_t q = 0; q < 4; ++q) {
      if (q != p) star.add(q, square[q], weight[q] - weight[p]);
    }
    if (neighbours_of(star).contains((p + 2) % 4)) diagonals.insert({p, (p + 2) % 4});
  }
  EXPECT_EQ(diagonals.size(), 1U);
}

TEST(TangentStar, OrderOfNeighboursDoesNotMatter) {
  TangentStar forth;
  TangentStar back;
  forth.begin(kOrigin, kUp, 10);
  back.begin(kOrigin, kUp, 10);
  for (std::uint32_t i = 0; i < 40; ++i) {
    const auto at = [](std::uint32_t k) {
      return Vec3d(std::sin(1.7 * k + 0.3) * (1 + 0.05 * k), std::cos(2.9 * k) * (1 + 0.03 * k),
                   0.1 * std::sin(k));
    };
    forth.add(i, at(i), 0);
    back.add(39 - i, at(39 - i), 0);
  }
  EXPECT_EQ(neighbours_of(forth), neighbours_of(back));
  EXPECT_EQ(forth.corners().size(), back.corners().size());
}

}  // namespace
}  // namespace meshrepair
