// SPDX-License-Identifier: MIT
#include "drains/bore.h"

#include <cmath>

#include <gtest/gtest.h>

#include "shapes.h"

namespace meshrepair::internal {
namespace {

using testing::append;
using testing::box;
using testing::flipped;
using testing::Random;
using testing::sphere;

std::optional<Bore> bore_into(const TriangleSoup& solid, const Vec3d& point, const BoreSize& size) {
  const Depth depth(solid);
  const Place place = depth.place(point, 0);
  const Vec3d mouth = depth.foot(place);
  return bore_at(depth, mouth, (point - mouth).normalized(), place.nearest, size);
}

TEST(Bore, KnowsItsDistanceFromTheFacesBeside) {
  for (const double x : {0.2, 1.0, 1.7, 2.9}) {
    const auto bore = bore_into(box({0, 0, 0}, {20, 20, 20}), Vec3d(x, 10, 0.1), {1, 2});
    ASSERT_TRUE(bore);
    EXPECT_NEAR(bore->beside, std::min(x - 1, 1.04), 0.01);
    EXPECT_LE(bore->beside, std::min(x - 1, 1.04));
    if (x < 2) {
      EXPECT_NEAR(bore->away.x(), 1, 1e-9);
    }
    EXPECT_NEAR(bore->length, 1.04, 0.002);
    EXPECT_EQ(bore->reach > 0, x > 1.01);
  }
}

// A bump, or a step, of a tenth of the wall is relief; a slit as deep as the wall is not.
TEST(Bore, ReliefIsOfTheSurfaceAroundTheMouth) {
  TriangleSoup solid = box({0, 0, 0}, {20, 20, 20});
  append(solid, flipped(box({10.5, 9, 0.3}, {10.8, 11, 2})));
  const auto beside = bore_into(solid, Vec3d(9, 10, 0.1), {1, 2});
  ASSERT_TRUE(beside);
  EXPECT_NEAR(beside->beside, 0.5, 0.01);
}

TEST(Bore, IsAsLongAsItsWholeSectionNeeds) {
  const TriangleSoup ball = sphere(3000);
  const Depth depth(ball);
  for (const double diameter : {0.1, 0.4, 1.0}) {
    const auto bore = bore_into(ball, Vec3d(0, 0.01, 0.9), {0.1, diameter});
    ASSERT_TRUE(bore);
    const double radius = diameter / 2;
    const double exact = 1 - std::sqrt(0.896 * 0.896 - radius * radius);
    EXPECT_GT(bore->length, exact - 0.01);
    EXPECT_LT(bore->length, exact + 0.08 * diameter);  // the facet at the mouth is tilted
  }
  EXPECT_FALSE(bore_into(ball, Vec3d(0, 0.01, 0.9), {0.1, 1.9}) &&
               bore_into(ball, Vec3d(0, 0.01, 0.9), {0.1, 1.9})->beside > 0);
}

}  // namespace
}  // namespace meshrepair::internal
