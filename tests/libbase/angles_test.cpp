// SPDX-License-Identifier: MIT
// Angles have the same bits on every system.
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include <base/angles.h>

namespace meshrepair {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(Angles, HaveTheseBits) {
  EXPECT_EQ(arc_tangent(1, 3), 0x1.4978fa3269ee1p-2);
  EXPECT_EQ(arc_tangent(-0.7, 0.1), -0x1.6dcc57bb565fcp+0);
  EXPECT_EQ(arc_cosine(0.3), 0x1.441f5ecbeef58p+0);
  EXPECT_EQ(cosine_and_sine(0.7).cosine, 0x1.87996529f9d93p-1);
  EXPECT_EQ(cosine_and_sine(-2.5).sine, -0x1.326af0dcfcaafp-1);
}

TEST(Angles, OfAxesAreExact) {
  EXPECT_EQ(arc_tangent(0, 0), 0);
  EXPECT_EQ(arc_tangent(0, 5), 0);
  EXPECT_EQ(arc_tangent(5, 0), kPi / 2);
  EXPECT_EQ(arc_tangent(-1e-320, 0), -kPi / 2);
  EXPECT_EQ(arc_tangent(0, -1e308), kPi);
  EXPECT_EQ(arc_cosine(1), 0);
  EXPECT_EQ(arc_cosine(0), kPi / 2);
  EXPECT_EQ(arc_cosine(-1), kPi);
  EXPECT_EQ(cosine_and_sine(0).cosine, 1);
  EXPECT_EQ(cosine_and_sine(0).sine, 0);
}

TEST(Angles, AreNearThoseOfTheCLibrary) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int i = 0; i < 100000; ++i) {
    const double y = std::ldexp(number(random), -static_cast<int>(random() % 60));
    const double x = std::ldexp(number(random), -static_cast<int>(random() % 60));
    const double angle = arc_tangent(y, x);
    ASSERT_NEAR(angle, std::atan2(y, x), std::abs(angle) * 0x1p-50) << y << ' ' << x;
    ASSERT_EQ(arc_tangent(-y, x), -angle);
    const double cosine = number(random);
    ASSERT_NEAR(arc_cosine(cosine), std::acos(cosine), arc_cosine(cosine) * 0x1p-50) << cosine;
    const double turned = 10 * kPi * number(random);
    ASSERT_NEAR(cosine_and_sine(turned).cosine, std::cos(turned), 0x1p-49) << turned;
    ASSERT_NEAR(cosine_and_sine(turned).sine, std::sin(turned), 0x1p-49) << turned;
  }
}

}  // namespace
}  // namespace meshrepair
