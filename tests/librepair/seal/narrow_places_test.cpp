// SPDX-License-Identifier: MIT
#include "seal/narrow_places.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "shapes.h"

namespace meshrepair::internal {
namespace {

using namespace testing;

constexpr double kBrickSide = 0.05;

// Of a soup between -2 and 2.
std::size_t narrow_bricks(const TriangleSoup& soup, double width) {
  const NarrowPlaces places(soup, Vec3d::Constant(-2), kBrickSide, width, nullptr);
  const auto found = places.find({80, 80, 80}, std::size_t{1} << 20);
  return found ? found->size() : std::size_t{1} << 20;
}

TriangleSoup hollow_box(double wall) {
  TriangleSoup soup = box({-1, -1, -1}, {1, 1, 1});
  const double inner = 1 - wall;
  append(soup, flipped(box({-inner, -inner, -inner}, {inner, inner, inner})));
  return soup;
}

// However rounding turns their walls by a hair.
TEST(NarrowPlaces, RightAnglesAreNotNarrow) {
  for (const double angle : {0.0, 0.3, 0.7, 1.1, 1.3}) {
    Eigen::Matrix3d turn;
    turn = Eigen::AngleAxisd(angle, Vec3d(1, 2, 3).normalized());
    EXPECT_EQ(narrow_bricks(transformed(hollow_box(0.2), turn), 0.1), 0u) << angle;
  }
}

TEST(NarrowPlaces, NarrowSlitsAreFound) {
  const auto slit = [](double width) {
    TriangleSoup soup = box({-1, -1, -1}, {-width / 2, 1, 1});
    append(soup, box({width / 2, -1, -1}, {1, 1, 1}));
    return soup;
  };
  // All of it, in one or two layers of bricks.
  EXPECT_GE(narrow_bricks(slit(0.06), 0.1), 40u * 40u);
  EXPECT_EQ(narrow_bricks(slit(0.3), 0.1), 0u);
}

}  // namespace
}  // namespace meshrepair::internal
