// SPDX-License-Identifier: MIT
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <mesh/far_coordinates.h>

namespace meshrepair {
namespace {

std::vector<Vec3d> points_around(const Vec3d& middle, double size, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> beside(-size / 2, size / 2);
  std::vector<Vec3d> points;
  for (int i = 0; i < 500; ++i)
    points.push_back(middle + Vec3d(beside(random), beside(random), beside(random)));
  return points;
}

TEST(FittingOffset, IsSubtractedAndAddedWithoutRounding) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> exponent(-3, 8);
  for (std::uint32_t seed = 0; seed < 300; ++seed) {
    const Vec3d middle(std::pow(10, exponent(random)), -std::pow(10, exponent(random)),
                       std::pow(10, exponent(random)));
    const double size = std::pow(10, exponent(random) / 2);
    for (const Vec3d& point : points_around(middle, size, seed)) {
      const Vec3d offset = fitting_offset(points_around(middle, size, seed), 0);
      const Vec3d near = point - offset;
      ASSERT_EQ(near + offset, point) << "seed " << seed;
      // And the difference is what it is without rounding.
      for (int axis = 0; axis < 3; ++axis) {
        ASSERT_EQ(std::fma(1.0, point[axis], -offset[axis]), near[axis]);
      }
      if (seed % 50 != 0) break;
    }
  }
}

TEST(FittingOffset, LeavesNothingToLose) {
  for (const Vec3d& middle : {Vec3d(500'000, 4'649'776, 120), Vec3d(1e7, 1e7, 1e7),
                              Vec3d(-691'000.25, 5'334'123.5, 0), Vec3d(1000, 1000, 1000)}) {
    for (const double size : {0.01, 1.0, 12.0, 900.0}) {
      std::vector<Vec3d> points = points_around(middle, size, 3);
      const Vec3d offset = fitting_offset(points, 0);
      for (Vec3d& point : points) point -= offset;
      EXPECT_FALSE(single_precision_loss(points, 0).matters)
          << size << " at " << middle.transpose();
    }
  }
}

TEST(FittingOffset, IsNoneWhereSinglePrecisionHoldsThePoints) {
  EXPECT_EQ(fitting_offset(points_around({0, 0, 0}, 100, 1), 0), Vec3d::Zero());
  EXPECT_EQ(fitting_offset(points_around({500, 20, -3}, 100, 1), 1), Vec3d::Zero());
  EXPECT_EQ(fitting_offset({}, 0), Vec3d::Zero());
  // But in axes that are far off alone.
  const Vec3d offset = fitting_offset(points_around({4e6, 1, 0}, 20, 1), 0);
  EXPECT_NE(offset.x(), 0);
  EXPECT_EQ(offset.y(), 0);
}

TEST(SinglePrecisionLoss, IsMeasured) {
  const std::vector<Vec3d> points = {{500'000.2, 4'649'776.3, 1}, {500'010, 4'649'790, 5}};
  const SinglePrecisionLoss loss = single_precision_loss(points, 0);
  EXPECT_EQ(loss.step, 0.5);
  EXPECT_NEAR(loss.move, 0.2, 0.02);
  EXPECT_TRUE(loss.matters);
  EXPECT_FALSE(single_precision_loss(points_around({0, 0, 0}, 100, 1), 0.1).matters);
  // A hair's breadth of the whole, but half of what neighbours are apart.
  const std::vector<Vec3d> wide = {{0, 0, 0}, {1e6, 1e6, 0}, {1e6 + 0.03, 1e6, 0}};
  EXPECT_FALSE(single_precision_loss(wide, 0).matters);
  EXPECT_TRUE(single_precision_loss(wide, 0.03).matters);
}

TEST(OffsetComment, IsFoundAgain) {
  for (const Vec3d& offset : {Vec3d(500'000, 4'649'776, 0), Vec3d(0.1, -1e300, 1e-5)}) {
    for (const std::string before : {"# ", "//", "ply\nformat ascii 1.0\ncomment ", "\n# x\n#"}) {
      EXPECT_EQ(find_offset_comment(before + offset_comment(offset) + "\nv 1 2 3\n"), offset);
    }
  }
  EXPECT_EQ(find_offset_comment("# Offset: 1, 2, 3\r\n"), Vec3d(1, 2, 3));
  for (const std::string other : {"", "# offset 1 2", "# offset 1 2 3 4", "# offset 1 2 inf",
                                  "# offsets 1 2 3", "offset 1 2 3", "v 1 2 3 # offset 1 2 3"}) {
    EXPECT_EQ(find_offset_comment(other), std::nullopt) << other;
  }
  EXPECT_EQ(find_offset_comment(std::string(20'000, '\n') + "# offset 1 2 3"), std::nullopt);
}

}  // namespace
}  // namespace meshrepair
