// SPDX-License-Identifier: MIT
// Roots have the same bits on every system.
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include <base/roots.h>

namespace meshrepair {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

TEST(Hypotenuse, HasTheseBits) {
  EXPECT_EQ(hypotenuse(1, 3), 0x1.94c583ada5b53p+1);
  EXPECT_EQ(hypotenuse(-0.7, 0.1), 0x1.6a09e667f3bccp-1);
  EXPECT_EQ(hypotenuse(0.3, 1e-9), 0x1.3333333333333p-2);
  EXPECT_EQ(hypotenuse(3e300, -4e307), 0x1.c7b1f3cac744ap+1021);
}

TEST(Hypotenuse, NeitherOverflowsNorUnderflows) {
  EXPECT_EQ(hypotenuse(0x3p1000, 0x4p1000), 0x5p1000);
  EXPECT_EQ(hypotenuse(0x3p-1070, 0x4p-1070), 0x5p-1070);
  EXPECT_EQ(hypotenuse(0x1.30811402b79e5p-1021, 0x1p-1074), 0x1.30811402b79e5p-1021);
  EXPECT_EQ(hypotenuse(0, -0x1p-1074), 0x1p-1074);
  EXPECT_EQ(hypotenuse(0, 0), 0);
}

TEST(Hypotenuse, OfInfinityIsInfiniteAlsoBesideNaN) {
  EXPECT_EQ(hypotenuse(-kInfinity, 1), kInfinity);
  EXPECT_EQ(hypotenuse(kNotANumber, kInfinity), kInfinity);
  EXPECT_TRUE(std::isnan(hypotenuse(kNotANumber, 1)));
}

TEST(Hypotenuse, IsNearTheOneOfTheCLibrary) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 100000; ++i) {
    const double x =
        std::ldexp(static_cast<double>(random() >> 11U), -static_cast<int>(random() % 60));
    const double y =
        std::ldexp(static_cast<double>(random() >> 11U), -static_cast<int>(random() % 60));
    const double length = hypotenuse(x, y);
    ASSERT_NEAR(length, std::hypot(x, y), length * 0x1p-52) << x << ' ' << y;
    ASSERT_EQ(hypotenuse(y, -x), length);
  }
}

TEST(Length, HasTheseBits) { EXPECT_EQ(stable_length({0.1, -0.7, 0.3}), 0x1.8946504494be3p-1); }

TEST(Length, NeitherOverflowsNorUnderflows) {
  EXPECT_EQ(stable_length({0x3p1000, 0, -0x4p1000}), 0x5p1000);
  EXPECT_EQ(stable_length({0x3p-1070, 0x4p-1070, 0}), 0x5p-1070);
  EXPECT_EQ(stable_length({0, 0, 0}), 0);
  EXPECT_EQ(stable_length({0, -kInfinity, 1}), kInfinity);
  EXPECT_TRUE(std::isnan(stable_length({kNotANumber, 1, 2})));
}

TEST(PowerOfTen, IsTheNearestNumber) {
  EXPECT_EQ(power_of_ten(0), 1);
  EXPECT_EQ(power_of_ten(-1), 0.1);
  EXPECT_EQ(power_of_ten(22), 1e22);
  EXPECT_EQ(power_of_ten(-22), 1e-22);
}

TEST(PowerOfTen, TheExponentOfAPowerIsItsOwn) {
  for (int exponent = -300; exponent <= 300; ++exponent) {
    const double power = power_of_ten(exponent);
    ASSERT_EQ(decimal_exponent(power), exponent);
    ASSERT_EQ(decimal_exponent(std::nextafter(power, kInfinity)), exponent);
    ASSERT_EQ(decimal_exponent(std::nextafter(power, 0.0)), exponent - 1);
  }
}

TEST(CubeRoot, HasTheseBits) {
  EXPECT_EQ(cube_root(2), 0x1.428a2f98d728bp+0);
  EXPECT_EQ(cube_root(0.1), 0x1.db4c7760bcff3p-2);
  EXPECT_EQ(cube_root(-1e-320), -0x1.94c7f15ef7ddfp-355);
}

TEST(CubeRoot, OfCubesIsExact) {
  for (double root = 1; root < 0x1p17; ++root) {
    ASSERT_EQ(cube_root(root * root * root), root);
    ASSERT_EQ(cube_root(-root * root * root / 0x1p18), -root / 0x1p6);
  }
}

TEST(CubeRoot, OfNoNumberIsItself) {
  EXPECT_EQ(cube_root(-kInfinity), -kInfinity);
  EXPECT_TRUE(std::isnan(cube_root(kNotANumber)));
  EXPECT_TRUE(std::signbit(cube_root(-0.0)));
}

TEST(CubeRoot, IsOffByOneInTheLastPlaceAtMost) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 100000; ++i) {
    const double x =
        std::ldexp(static_cast<double>(random() >> 11U), -static_cast<int>(random() % 1100));
    const double root = cube_root(x);
    const auto rounded = static_cast<double>(std::cbrt(static_cast<long double>(x)));
    ASSERT_NEAR(root, rounded, root * 0x1p-52) << x;
  }
}

}  // namespace
}  // namespace meshrepair
