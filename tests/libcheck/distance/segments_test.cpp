// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <check/internal/segments.h>

#include "random_geometry.h"

namespace meshrepair::internal {
namespace {

using testing::Random;

TEST(Segments, ShortestWaysBetweenSegmentsAreShortest) {
  Random random(5);
  const auto point = [&] {
    return Vec3d(random.real(-1, 1), random.real(-1, 1), random.real(-1, 1));
  };
  for (int i = 0; i < 200; ++i) {
    Segment a = {point(), point()}, b = {point(), point()};
    if (i % 5 == 0) b.to = b.from;
    if (i % 7 == 0) a.to = a.from;
    if (i % 11 == 0) b = {a.from + Vec3d(0, 0, 1), a.to + Vec3d(0, 0, 1)};
    const Segment shortest = shortest_between(a, b);
    const double length = (shortest.to - shortest.from).norm();
    for (int k = 0; k < 50; ++k) {
      const double s = random.real(0, 1), t = random.real(0, 1);
      const Vec3d p = a.from + s * (a.to - a.from), q = b.from + t * (b.to - b.from);
      EXPECT_LE(length, (p - q).norm() + 1e-12);
    }
  }
}

TEST(Segments, LinesAreAsFarApartAsTheyAre) {
  const Segment a = {{0, 0, 0}, {1, 0, 0}}, b = {{5, 1, 3}, {5, 2, 3}};
  EXPECT_DOUBLE_EQ(distance_of_lines(a, b), 3);
  EXPECT_DOUBLE_EQ(distance_of_lines(a, {{0, -1, 0}, {0, 1, 0}}), 0);
}

}  // namespace
}  // namespace meshrepair::internal
