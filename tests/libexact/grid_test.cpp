// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <exact/grid.h>

#include "each_seed.h"
#include "random_geometry.h"

namespace meshrepair {
namespace {

using testing::Random;

bool within_radius(const GridPoint& p) {
  const auto inside = [](std::int32_t x) { return x >= -kGridRadius && x <= kGridRadius; };
  return inside(p.x) && inside(p.y) && inside(p.z);
}

Vec3d place(const Grid& grid, const GridPoint& p) {
  return grid.from_grid(
      {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)});
}

bool is_power_of_two(double x) {
  int exponent = 0;
  return std::isfinite(x) && x > 0 && std::frexp(x, &exponent) == 0.5;
}

struct Box {
  Vec3d low, high;
};

// Boxes of every size and place, most of them with corners that are no round numbers.
Box random_box(Random& random) {
  const double size = std::ldexp(random.real(0.5, 1), random.integer(-60, 60));
  const double offset = random.chance(0.3) ? 0 : std::ldexp(size, random.integer(-5, 20));
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = offset * random.real(-1, 1) + size * random.real(-1, 1);
    const double b = random.chance(0.1) ? a : a + size * random.real(0, 1);
    box.low[axis] = std::min(a, b);
    box.high[axis] = std::max(a, b);
  }
  return box;
}

Vec3d random_point(Random& random, const Box& box) {
  Vec3d p;
  for (int axis = 0; axis < 3; ++axis) {
    p[axis] = std::min(box.high[axis], random.real(box.low[axis], box.high[axis]));
  }
  return p;
}

TEST(Grid, PointsMoveByHalfAUnitAtMostAndStayWithinTheRadius) {
  for_each_seed(2000, [&](std::uint64_t seed) {
    Random random(seed);
    const Box box = random_box(random);
    const Grid grid = make_grid(box.low, box.high);
    ASSERT_TRUE(is_power_of_two(grid.unit));
    std::vector<Vec3d> points = {box.low, box.high};
    for (int i = 0; i < 10; ++i) points.push_back(random_point(random, box));
    for (const Vec3d& p : points) {
      const GridPoint g = grid.to_grid(p);
      ASSERT_TRUE(within_radius(g));
      // What double rounding adds to half a unit is the spacing of doubles at the point's own size.
      const double rounding = 0x1p-51 * p.cwiseAbs().maxCoeff();
      EXPECT_LE((place(grid, g) - p).cwiseAbs().maxCoeff(), 0.5 * grid.unit + rounding);
    }
  });
}

TEST(Grid, NoBitsAreWasted) {
  for_each_seed(500, [&](std::uint64_t seed) {
    Random random(seed);
    const Box box = random_box(random);
    const double extent = (box.high - box.low).maxCoeff();
    if (extent == 0) return;
    const Grid grid = make_grid(box.low, box.high);
    EXPECT_GE(extent / grid.unit, 0.499 * kGridRadius);
  });
}

TEST(Grid, RoundTripOfGridPointsIsExact) {
  for_each_seed(200, [&](std::uint64_t seed) {
    Random random(seed);
    const double unit = std::ldexp(1.0, random.integer(-200, 200));
    const Vec3d low = unit * Vec3d(random.integer(-kGridRadius, 0), 5, 7);
    const Vec3d high = low + unit * Vec3d(random.integer(1, kGridRadius), 9, 0);
    const Grid grid = make_grid(low, high);
    for (int i = 0; i < 50; ++i) {
      const GridPoint g = random.grid_point();
      EXPECT_EQ(grid.to_grid(place(grid, g)), g);
    }
  });
}

// Coordinates that are multiples of the unit are kept without any error.
TEST(Grid, MultiplesOfTheUnitAreExact) {
  for_each_seed(500, [&](std::uint64_t seed) {
    Random random(seed);
    const std::int32_t size = random.integer(1, 1 << 20);
    Vec3d low, high;
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = random.integer(-1000, 1000);
      high[axis] = low[axis] + random.integer(axis == 0 ? 1 : 0, size);
    }
    const Grid grid = make_grid(low, high);
    ASSERT_LE(grid.unit, 1.0);
    for (int i = 0; i < 20; ++i) {
      Vec3d p;
      for (int axis = 0; axis < 3; ++axis) {
        p[axis] = random.integer(static_cast<std::int32_t>(low[axis]),
                                 static_cast<std::int32_t>(high[axis]));
      }
      EXPECT_EQ(place(grid, grid.to_grid(p)), p);
    }
  });
}

TEST(Grid, ScalingByTwoKeepsGridCoordinates) {
  for_each_seed(1000, [&](std::uint64_t seed) {
    Random random(seed);
    const Box box = random_box(random);
    const Grid grid = make_grid(box.low, box.high);
    const Grid doubled = make_grid(2 * box.low, 2 * box.high);
    EXPECT_EQ(doubled.unit, 2 * grid.unit);
    EXPECT_EQ(doubled.origin, 2 * grid.origin);
    for (int i = 0; i < 10; ++i) {
      const Vec3d p = random_point(random, box);
      EXPECT_EQ(grid.to_grid(p), doubled.to_grid(2 * p));
    }
  });
}

// Odd numbers of steps as well, with the centre of the box between two grid points.
TEST(Grid, MovingByMultiplesOfTheUnitKeepsGridCoordinates) {
  for_each_seed(1000, [&](std::uint64_t seed) {
    Random random(seed);
    // The extent is in [1/2, 1), so this is the grid's own unit, or half of it for the largest
    // boxes.
    const double unit = 0x1p-26;
    Box box;
    for (int axis = 0; axis < 3; ++axis) {
      box.low[axis] = unit * random.integer(0, 1 << 25);
      box.high[axis] = box.low[axis] + unit * random.integer(1 << 25, (1 << 26) - 1);
    }
    const Grid grid = make_grid(box.low, box.high);
    const Vec3d by = grid.unit * Vec3d(random.integer(-1000, 1000), random.integer(-1000, 1000),
                                       random.integer(-1000, 1000));
    const Grid moved = make_grid(box.low + by, box.high + by);
    EXPECT_EQ(moved.unit, grid.unit);
    EXPECT_EQ(moved.origin, grid.origin + by);
    for (const Vec3d& p : {box.low, box.high}) EXPECT_EQ(moved.to_grid(p + by), grid.to_grid(p));
  });
}

TEST(Grid, HugeBoxesDoNotOverflow) {
  const double most = std::numeric_limits<double>::max();
  for (const double size : {1e300, 0.5 * most, most}) {
    SCOPED_TRACE(size);
    for (const double low : {-size, 0.0, 0.25 * size}) {
      SCOPED_TRACE(low);
      const Vec3d a = Vec3d::Constant(low);
      const Vec3d b = Vec3d::Constant(size);
      const Grid grid = make_grid(a, b);
      ASSERT_TRUE(is_power_of_two(grid.unit));
      ASSERT_TRUE(grid.origin.allFinite());
      EXPECT_TRUE(within_radius(grid.to_grid(a)));
      EXPECT_TRUE(within_radius(grid.to_grid(b)));
      EXPECT_LT(grid.to_grid(a).x, grid.to_grid(b).x - kGridRadius / 2);
    }
  }
}

TEST(Grid, SmallBoxesFarFromTheOriginKeepNeighboursApart) {
  for (const double place_of_box : {1.0, 1e6, 1e16, 1e300, -1e300}) {
    SCOPED_TRACE(place_of_box);
    const double next = std::nextafter(place_of_box, std::numeric_limits<double>::infinity());
    const double after = std::nextafter(next, std::numeric_limits<double>::infinity());
    const Grid grid = make_grid(Vec3d::Constant(place_of_box), Vec3d::Constant(after));
    const GridPoint a = grid.to_grid(Vec3d::Constant(place_of_box));
    const GridPoint b = grid.to_grid(Vec3d::Constant(next));
    const GridPoint c = grid.to_grid(Vec3d::Constant(after));
    EXPECT_TRUE(within_radius(a) && within_radius(c));
    EXPECT_LT(a.x, b.x);
    EXPECT_LT(b.x, c.x);
  }
}

TEST(Grid, DenormalCoordinatesHaveAGrid) {
  const double least = std::numeric_limits<double>::denorm_min();
  for (const double size : {least, 3 * least, 1e-310, 1e-300}) {
    SCOPED_TRACE(size);
    const Vec3d low = Vec3d::Zero();
    const Vec3d high = Vec3d::Constant(size);
    const Grid grid = make_grid(low, high);
    ASSERT_TRUE(is_power_of_two(grid.unit));
    EXPECT_TRUE(within_radius(grid.to_grid(low)));
    EXPECT_TRUE(within_radius(grid.to_grid(high)));
    EXPECT_LT(grid.to_grid(low), grid.to_grid(high));
  }
}

TEST(Grid, ASinglePointIsTheOrigin) {
  for (const Vec3d& p : {Vec3d(0, 0, 0), Vec3d(1, -2, 3), Vec3d(1e300, 1, 0), Vec3d(5e-324, 0, 0),
                         Vec3d(0.1, 0.2, 0.3)}) {
    SCOPED_TRACE(p.transpose());
    const Grid grid = make_grid(p, p);
    ASSERT_TRUE(is_power_of_two(grid.unit));
    EXPECT_TRUE(within_radius(grid.to_grid(p)));
    EXPECT_TRUE(place(grid, grid.to_grid(p)).isApprox(p, 1e-7));
  }
}

TEST(Grid, FlatBoxesUseTheirLargestSide) {
  const Grid flat = make_grid({0, 0, 4}, {1, 3, 4});
  const Grid cube = make_grid({0, 0, 0}, {3, 3, 3});
  EXPECT_EQ(flat.unit, cube.unit);
  EXPECT_EQ(flat.to_grid({0, 0, 4}).z, flat.to_grid({1, 3, 4}).z);
}

TEST(Grid, NegativeZeroIsZero) {
  const Grid grid = make_grid({-1, -1, -1}, {1, 1, 1});
  EXPECT_EQ(grid.to_grid({-0.0, 0.0, -0.0}), grid.to_grid({0.0, -0.0, 0.0}));
}

}  // namespace
}  // namespace meshrepair
