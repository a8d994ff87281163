// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <exact/predicates.h>
#include <extract/float_engine.h>

#include "random_geometry.h"
#include "shapes.h"

namespace meshrepair {
namespace {

using namespace testing;

// x = 0, the positive side being x > 0, and others.
class FloatSides : public ::testing::Test {
 protected:
  PlaneId plane(const std::array<std::int64_t, 3>& normal, std::int64_t offset) {
    return planes_.append(make_plane(normal, offset));
  }

  PlaneTable planes_;
};

TEST_F(FloatSides, SidesWithinTheToleranceAreZero) {
  const PlaneId x = plane({1, 0, 0}, 0);
  FloatEngine engine(0.25);
  EXPECT_EQ(engine.side(loose_point({0.251, 7, 7}), x, planes_), 1);
  EXPECT_EQ(engine.side(loose_point({0.25, 7, 7}), x, planes_), 0);
  EXPECT_EQ(engine.side(loose_point({-0.25, 7, 7}), x, planes_), 0);
  EXPECT_EQ(engine.side(loose_point({-0.251, 7, 7}), x, planes_), -1);
  EXPECT_EQ(engine.side(lattice_point({0, 7, 7}), x, planes_), 0);
}

TEST_F(FloatSides, WithoutAToleranceAreSignsOfDistances) {
  const PlaneId x = plane({1, 0, 0}, 0);
  FloatEngine engine(0);
  EXPECT_EQ(engine.side(loose_point({1e-300, 0, 0}), x, planes_), 1);
  EXPECT_EQ(engine.side(loose_point({-1e-300, 0, 0}), x, planes_), -1);
  EXPECT_EQ(engine.side(loose_point({0, 0, 0}), x, planes_), 0);
}

TEST_F(FloatSides, SidesFarFromThePlaneAreExact) {
  Random random(1);
  FloatEngine engine(1);
  std::size_t near = 0;
  for (int i = 0; i < 10000; ++i) {
    const Plane p = plane_through(random.grid_point(), random.grid_point(), random.grid_point());
    if (is_null(p)) continue;
    const PlaneId id = planes_.append(p);
    const Point at = lattice_point(random.grid_point(i % 2 == 0 ? kGridRadius : 8));
    const int said = engine.side(at, id, planes_);
    near += said == 0;
    if (said == 0) continue;
    EXPECT_EQ(said, side(at, id, planes_));
  }
  EXPECT_LT(near, 100u);
}

// What comes after the clipper asks the points themselves.
TEST_F(FloatSides, OfLooseThePointsSayTheSameAsTheEngine) {
  Random random(2);
  FloatEngine engine(3e-3);
  std::array<std::size_t, 3> seen{};
  for (int i = 0; i < 10000; ++i) {
    const PlaneId id =
        plane({random.integer(-9, 9), random.integer(-9, 9), 10}, random.integer(-99, 99));
    const Point a = loose_point({random.real(-9, 9), random.real(-9, 9), random.real(-9, 9)});
    const Point b = lattice_point(random.grid_point(9));
    for (const Point& p :
         {loose_point(a.position, engine.tolerance()), engine.cross(a, b, {}, {}, id, planes_)}) {
      const int said = engine.side(p, id, planes_);
      EXPECT_EQ(said, side(p, id, planes_));
      EXPECT_EQ(said, side(p, planes_[id], planes_));
      ++seen[static_cast<std::size_t>(said + 1)];
    }
  }
  for (const std::size_t count : seen) EXPECT_GT(count, 100u);
}

TEST(FloatEngine, ToleranceIsRelativeToTheLargestSideOfTheInput) {
  CleanReport report;
  const CleanSoup soup = clean_soup(cube(), report);
  const GridBox box = bounding_box(soup);
  const double side = static_cast<double>(box.high.x) - box.low.x;
  EXPECT_GE(side, 0x1p24);
  EXPECT_FLOAT_EQ(static_cast<float>(FloatEngine(soup, 5e-10).tolerance()),
                  static_cast<float>(5e-10 * side));
  EXPECT_EQ(FloatEngine(soup, 0).tolerance(), 0);
}

TEST(Interpolate, IsWhereTheDistanceIsZero) {
  const Plane x = make_plane({1, 0, 0}, -3);
  const Point at = interpolate(loose_point({2, 0, 4}), loose_point({6, 8, 0}, 0.5), x);
  EXPECT_EQ(at.position, (std::array<double, 3>{3, 2, 3}));
  EXPECT_TRUE(at.is_loose());
  EXPECT_EQ(at.error, 0.5F);
}

TEST(Interpolate, EqualDistancesGiveTheMiddle) {
  const Plane x = make_plane({1, 0, 0}, -3);
  const Point at = interpolate(loose_point({5, 0, 4}), loose_point({5, 8, 0}), x);
  EXPECT_EQ(at.position, (std::array<double, 3>{5, 4, 2}));
}

TEST(Interpolate, NeverLeavesTheEdge) {
  Random random(3);
  for (int i = 0; i < 10000; ++i) {
    const Plane p = plane_through(random.grid_point(), random.grid_point(), random.grid_point());
    if (is_null(p)) continue;
    const Point a = lattice_point(random.grid_point(i % 3 == 0 ? 2 : kGridRadius));
    const Point b = lattice_point(random.grid_point(i % 3 == 0 ? 2 : kGridRadius));
    const Point at = interpolate(a, b, p);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto [low, high] = std::minmax(a.position[axis], b.position[axis]);
      EXPECT_GE(at.position[axis], low - 1e-7);
      EXPECT_LE(at.position[axis], high + 1e-7);
    }
  }
}

}  // namespace
}  // namespace meshrepair
