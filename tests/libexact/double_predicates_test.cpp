// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include <gtest/gtest.h>

#include <exact/double_predicates.h>
#include <exact/wide_int.h>

#include "double_predicates_internal.h"
#include "random_geometry.h"

namespace meshrepair {
namespace {

using testing::Random;
using Points = std::array<Vec3d, 4>;

int orientation(const Points& p) { return meshrepair::orientation(p[0], p[1], p[2], p[3]); }

// Exact for integer coordinates below 2^39.
int integer_orientation(const Points& p) {
  std::array<std::array<Int128, 3>, 3> row{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      row[i][static_cast<std::size_t>(k)] =
          static_cast<std::int64_t>(p[i + 1][k]) - static_cast<std::int64_t>(p[0][k]);
    }
  }
  return sign_of(row[0][0] * (row[1][1] * row[2][2] - row[1][2] * row[2][1]) -
                 row[0][1] * (row[1][0] * row[2][2] - row[1][2] * row[2][0]) +
                 row[0][2] * (row[1][0] * row[2][1] - row[1][1] * row[2][0]));
}

Vec3d random_point(Random& random, double radius) {
  return {random.real(-radius, radius), random.real(-radius, radius), random.real(-radius, radius)};
}

// Three points, and one as near to their plane as doubles allow.
Points nearly_coplanar(Random& random) {
  Points p = {random_point(random, 1), random_point(random, 1), random_point(random, 1), {}};
  const double s = random.real(-1, 2), t = random.real(-1, 2);
  p[3] = (1 - s - t) * p[0] + s * p[1] + t * p[2];
  return p;
}

// Every coordinate of its own magnitude, among all that doubles have.
Points of_any_magnitude(Random& random) {
  Points p;
  for (Vec3d& point : p) {
    for (double& x : point) {
      x = std::ldexp(random.real(-1, 1), random.integer(-1073, 1024));
    }
  }
  return p;
}

void expect_consistent(const Points& p) {
  const int sign = orientation(p);
  EXPECT_EQ(orientation({p[1], p[0], p[2], p[3]}), -sign);
  EXPECT_EQ(orientation({p[0], p[2], p[1], p[3]}), -sign);
  EXPECT_EQ(orientation({p[0], p[1], p[3], p[2]}), -sign);
  EXPECT_EQ(orientation({p[3], p[2], p[1], p[0]}), sign);
  EXPECT_EQ(orientation({p[1], p[2], p[0], p[3]}), sign);
  EXPECT_EQ(internal::long_orientation(p[0], p[1], p[2], p[3]), sign);
  const auto by_short = internal::short_orientation(p[0], p[1], p[2], p[3]);
  EXPECT_EQ(by_short.value_or(sign), sign);
  const int filtered = internal::PlaneFilter(p[0], p[1], p[2]).side(p[3]);
  EXPECT_TRUE(filtered == 0 || filtered == sign);
  const int filtered_long = internal::filtered_long_orientation(p[0], p[1], p[2], p[3]);
  EXPECT_TRUE(filtered_long == 0 || filtered_long == sign);
}

TEST(Orientation, IsPositiveWhereTheNormalPoints) {
  EXPECT_EQ(orientation({Vec3d{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}), 1);
  EXPECT_EQ(orientation({Vec3d{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}}), -1);
  EXPECT_EQ(orientation({Vec3d{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {7, 9, 0}}), 0);
  EXPECT_EQ(orientation({Vec3d{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {7, 9, 0}}), 0);
}

TEST(Orientation, AgreesWithIntegers) {
  Random random(1);
  int zeros = 0;
  for (int i = 0; i < 200000; ++i) {
    const std::int32_t radius = i % 3 == 0 ? 2 : i % 3 == 1 ? 1000 : 1000000000;
    Points p;
    for (Vec3d& point : p) {
      for (double& x : point) x = random.integer(-radius, radius);
    }
    if (i % 2 == 1) p[3] = p[0] + 2 * (p[1] - p[0]) - 3 * (p[2] - p[0]);
    if (i % 4 == 3) p[3][random.integer(0, 2)] += random.integer(-1, 1);
    const int sign = integer_orientation(p);
    zeros += sign == 0;
    ASSERT_EQ(orientation(p), sign);
    ASSERT_EQ(internal::long_orientation(p[0], p[1], p[2], p[3]), sign);
  }
  EXPECT_GT(zeros, 20000);
}

TEST(Orientation, StagesAndPermutationsAgreeNearTheZero) {
  Random random(2);
  for (int i = 0; i < 20000; ++i) expect_consistent(nearly_coplanar(random));
}

TEST(Orientation, StagesAndPermutationsAgreeAtAnyMagnitude) {
  Random random(3);
  for (int i = 0; i < 5000; ++i) expect_consistent(of_any_magnitude(random));
}

TEST(Orientation, ScalingByAPowerOfTwoChangesNothing) {
  Random random(4);
  for (int i = 0; i < 5000; ++i) {
    Points p = nearly_coplanar(random);
    for (Vec3d& point : p) {
      for (double& x : point) x = std::round(x * 0x1p40) * 0x1p-40;
    }
    const int sign = orientation(p);
    for (const int power : {-1030, -600, -250, -40, 250, 400, 1020}) {
      Points q = p;
      for (Vec3d& point : q) {
        for (double& x : point) x = std::ldexp(x, power);
      }
      ASSERT_EQ(orientation(q), sign) << power;
    }
  }
}

TEST(Orientation, ExtremeDoublesNeitherOverflowNorUnderflow) {
  constexpr double kMost = std::numeric_limits<double>::max();
  constexpr double kLeast = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(orientation({Vec3d{-kMost, -kMost, -kMost},
                         {kMost, -kMost, -kMost},
                         {-kMost, kMost, -kMost},
                         {-kMost, -kMost, kMost}}),
            1);
  EXPECT_EQ(orientation({Vec3d{0, 0, 0}, {kLeast, 0, 0}, {0, kLeast, 0}, {0, 0, kLeast}}), 1);
  EXPECT_EQ(orientation({Vec3d{0, 0, 0}, {kMost, 0, 0}, {0, kMost, 0}, {0, 0, -kLeast}}), -1);
  EXPECT_EQ(orientation({Vec3d{0, 0, 0}, {kMost, 0, 0}, {0, kMost, 0}, {kMost, kMost, 0}}), 0);
}

TEST(Orientation, FilterDecidesOrdinaryPointsAndIntegersMostOfTheRest) {
  Random random(5);
  int filtered = 0, by_short = 0;
  for (int i = 0; i < 10000; ++i) {
    const Points p = {random_point(random, 1), random_point(random, 1), random_point(random, 1),
                      random_point(random, 1)};
    filtered += internal::PlaneFilter(p[0], p[1], p[2]).side(p[3]) != 0;
    const Points flat = {Vec3d{p[0].x(), p[0].y(), 1},
                         {p[1].x(), p[1].y(), 1},
                         {p[2].x(), p[2].y(), 1},
                         {p[3].x(), p[3].y(), 1}};
    by_short += internal::short_orientation(flat[0], flat[1], flat[2], flat[3]).has_value();
  }
  EXPECT_GT(filtered, 9990);
  EXPECT_GT(by_short, 4000);
}

TEST(Orientation, TwiceTheLengthDecidesNearTheZero) {
  Random random(6);
  int decided = 0, not_zero = 0;
  for (int i = 0; i < 10000; ++i) {
    const Points p = nearly_coplanar(random);
    decided += internal::filtered_long_orientation(p[0], p[1], p[2], p[3]) != 0;
    not_zero += internal::long_orientation(p[0], p[1], p[2], p[3]) != 0;
  }
  EXPECT_EQ(decided, not_zero);
  EXPECT_GT(not_zero, 5000);
}

TEST(OrientationAlong, IsTheComponentOfTheNormal) {
  EXPECT_EQ(orientation_along(2, {0, 0, 5}, {1, 0, 6}, {0, 1, 7}), 1);
  EXPECT_EQ(orientation_along(0, {5, 0, 0}, {6, 1, 0}, {7, 0, 1}), 1);
  EXPECT_EQ(orientation_along(1, {0, 5, 0}, {0, 6, 1}, {1, 7, 0}), 1);
  EXPECT_EQ(orientation_along(1, {0, 5, 0}, {0, 6, 1}, {0, 7, 3}), 0);
}

// Off the plane of the three points, the orientation in space is that of the projection.
TEST(OrientationAlong, AgreesWithOrientationInSpace) {
  Random random(6);
  for (int i = 0; i < 20000; ++i) {
    Points p = i % 2 == 0 ? nearly_coplanar(random) : of_any_magnitude(random);
    const int axis = random.integer(0, 2);
    if (i % 4 < 2) p[2] = p[0] + random.real(-1, 2) * (p[1] - p[0]);
    for (std::size_t k = 0; k < 3; ++k) {
      if (!p[k].allFinite()) p[k].setZero();
      p[k][axis] = 0;
    }
    p[3] = p[0];
    p[3][axis] = 1;
    const int sign = orientation_along(axis, p[0], p[1], p[2]);
    EXPECT_EQ(orientation(p), sign);
    EXPECT_EQ(orientation_along(axis, p[1], p[0], p[2]), -sign);
    EXPECT_EQ(orientation_along(axis, p[1], p[2], p[0]), sign);
    EXPECT_EQ(internal::long_orientation_along(axis, p[0], p[1], p[2]), sign);
  }
}

TEST(ProjectionAxis, TellsCollinearPointsExactly) {
  EXPECT_EQ(projection_axis({0, 0, 0}, {1, 2, 3}, {2, 4, 6}), -1);
  EXPECT_EQ(projection_axis({0, 0, 0}, {0, 0, 0}, {2, 4, 6}), -1);
  EXPECT_EQ(projection_axis({1, 1, 1}, {1, 1, 1}, {1, 1, 1}), -1);
  EXPECT_EQ(projection_axis({0, 0, 0}, {1, 2, 3}, {2, 4, 7}), 0);
  EXPECT_EQ(projection_axis({0, 0, 0}, {1, 0, 0}, {2, 0x1p-1074, 0}), 2);
  // The rounded normal of these is 0 in all components.
  EXPECT_NE(projection_axis({0, 0, 0}, {0x1p-600, 0, 0}, {0, 0x1p-600, 0}), -1);
}

}  // namespace
}  // namespace meshrepair
