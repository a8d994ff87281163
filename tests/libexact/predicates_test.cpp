// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <exact/predicates.h>

#include "predicates_internal.h"
#include "random_geometry.h"

namespace meshrepair {
namespace {

using testing::Random;

PlaneId add(PlaneTable& table, const Plane& plane) { return table.append(plane); }

Plane random_plane(Random& random, std::int32_t radius = kGridRadius) {
  Plane plane;
  do {
    plane = plane_through(random.grid_point(radius), random.grid_point(radius),
                          random.grid_point(radius));
  } while (is_null(plane));
  return plane;
}

// Exact side, by the last stage of the ladder alone.
int exact_side(const PlaneTable& table, const std::array<PlaneId, 3>& point, const Plane& plane) {
  return internal::side_exactly(
      internal::meet_exactly(table[point[0]], table[point[1]], table[point[2]]), plane);
}

TEST(WideInt, ProductsAndSumsAgreeWithDecompositions) {
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const Int128 a = Int128{random.integer(-2000000000, 2000000000)} << random.integer(0, 90);
    const Int128 b = Int128{random.integer(-2000000000, 2000000000)} << random.integer(0, 90);
    const std::int64_t c = random.integer(-2000000000, 2000000000);
    EXPECT_EQ(Int256::product(a, b), Int256::product(b, a));
    EXPECT_EQ(Int256::product(a, c), Int256(a).times(c));
    EXPECT_EQ(Int256::product(a + 1, b), Int256::product(a, b) + Int256(b));
    EXPECT_EQ(Int256::product(a, b).sign(), sign_of(a) * sign_of(b));
    EXPECT_EQ(Int256::product(-a, b), -Int256::product(a, b));
    EXPECT_NEAR(Int256::product(a, b).to_double(), static_cast<double>(a) * static_cast<double>(b),
                1e-15 * std::abs(static_cast<double>(a) * static_cast<double>(b)));
  }
}

TEST(Meet, LatticePointsAreRecognised) {
  Random random(2);
  for (int i = 0; i < 5000; ++i) {
    const GridPoint p = random.grid_point();
    PlaneTable table;
    std::array<PlaneId, 3> ids;
    for (auto& id : ids) {
      Plane plane;
      do {
        plane = plane_through(p, random.grid_point(), random.grid_point());
      } while (is_null(plane));
      id = add(table, plane);
    }
    const Point met = meet(table, ids[0], ids[1], ids[2], {});
    ASSERT_TRUE(met.is_lattice());
    EXPECT_EQ(met.lattice(), p);
  }
}

TEST(Meet, OrderOfPlanesDoesNotMatter) {
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    PlaneTable table;
    const PlaneId a = add(table, random_plane(random));
    const PlaneId b = add(table, random_plane(random));
    const PlaneId c = add(table, random_plane(random));
    const Point p = meet(table, a, b, c, {});
    const Point q = meet(table, c, a, b, {});
    EXPECT_EQ(p.position, q.position);
    EXPECT_EQ(p.planes, q.planes);
  }
}

TEST(Meet, ErrorBoundHolds) {
  Random random(4);
  int compared = 0;
  for (int i = 0; i < 20000; ++i) {
    const std::int32_t radius = 1 << random.integer(2, kGridBits - 1);
    const Plane a = random_plane(random, radius);
    const Plane b = random_plane(random, radius);
    const Plane c = random_plane(random, radius);
    const auto exact = internal::meet_exactly(a, b, c);
    const auto fast = internal::meet_approximately(a, b, c);
    if (exact.denominator.sign() == 0) {
      EXPECT_GT(fast.error, 1.0);
      continue;
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double truth = exact.numerator[axis].to_double() / exact.denominator.to_double();
      if (std::abs(truth) > 0x1p26) break;  // the bound speaks of points inside the box
      EXPECT_LE(std::abs(truth - fast.position[axis]), fast.error + 0x1p-25);
      ++compared;
    }
  }
  EXPECT_GT(compared, 5000);
}

TEST(Meet, ParallelPlanesGiveALoosePointAtTheFallback) {
  PlaneTable table;
  const PlaneId a = add(table, make_plane({1, 0, 0}, 0));
  const PlaneId b = add(table, make_plane({1, 0, 0}, -5));
  const PlaneId c = add(table, make_plane({0, 1, 0}, 0));
  const Point p = meet(table, a, b, c, {1, 2, 3});
  EXPECT_TRUE(p.is_loose());
  EXPECT_EQ(p.position, (std::array<double, 3>{1, 2, 3}));
}

// Planes through common points give every degenerate position there is.
TEST(Side, CoverageEveryStageDecides) {
  Random random(5);
  int by_filter = 0, by_own_plane = 0, by_128 = 0, by_256 = 0;
  for (int i = 0; i < 3000; ++i) {
    PlaneTable table;
    const PlaneId a = add(table, random_plane(random));
    const PlaneId b = add(table, random_plane(random));
    const PlaneId c = add(table, random_plane(random));
    const Point p = meet(table, a, b, c, {});
    if (p.is_loose()) continue;
    // A plane of the pencil through the line of a and b and therefore through the point.
    const Plane& u = table[a];
    const Plane& v = table[b];
    const PlaneId pencil =
        add(table, make_plane({u.normal[0] / 4 - v.normal[0] / 4, u.normal[1] / 4 - v.normal[1] / 4,
                               u.normal[2] / 4 - v.normal[2] / 4},
                              u.offset / 4 - v.offset / 4));
    for (const PlaneId id : {a, pencil, add(table, random_plane(random))}) {
      const double distance = signed_distance(p.position, table[id]);
      const bool filtered =
          std::abs(distance) > kDistanceError + 1.7321 * static_cast<double>(p.error);
      by_filter += filtered;
      by_own_plane += !filtered && id == a;
      by_128 += !filtered && p.is_lattice();
      by_256 += !filtered && id != a && !p.is_lattice();
      EXPECT_EQ(side(p, id, table), exact_side(table, {a, b, c}, table[id]));
    }
    const GridPoint g = random.grid_point();
    const Plane through = plane_through(g, random.grid_point(), random.grid_point());
    if (is_null(through)) continue;
    const PlaneId id = add(table, through);
    ++by_128;
    EXPECT_EQ(side(lattice_point(g), id, table), 0);
  }
  EXPECT_GT(by_filter, 0);
  EXPECT_GT(by_own_plane, 0);
  EXPECT_GT(by_128, 0);
  EXPECT_GT(by_256, 0);
}

TEST(Side, ConsistencyOfAllStagesOnSmallGrids) {
  Random random(6);
  int zeros = 0;
  for (int i = 0; i < 50000; ++i) {
    const std::int32_t radius = random.integer(1, 6);
    PlaneTable table;
    const PlaneId a = add(table, random_plane(random, radius));
    const PlaneId b = add(table, random_plane(random, radius));
    const PlaneId c = add(table, random_plane(random, radius));
    const PlaneId d = add(table, random_plane(random, radius));
    if (internal::meet_exactly(table[a], table[b], table[c]).denominator.sign() == 0) continue;
    const Point p = meet(table, a, b, c, {});
    const int expected = exact_side(table, {a, b, c}, table[d]);
    ASSERT_EQ(side(p, d, table), expected);
    ASSERT_EQ(side(p, table[d], table), expected);
    Plane turned = make_plane({-table[d].normal[0], -table[d].normal[1], -table[d].normal[2]},
                              -table[d].offset);
    ASSERT_EQ(side(p, turned, table), -expected);
    zeros += expected == 0;
  }
  EXPECT_GT(zeros, 1000);
}

// Two planes tilted by one grid step over the whole box: the hardest position for rounding.
TEST(Side, NearlyParallelPlanesAreToldApart) {
  const std::int32_t r = kGridRadius;
  PlaneTable table;
  const PlaneId flat = add(table, plane_through({-r, -r, 0}, {r, -r, 0}, {r, r, 0}));
  const PlaneId tilted = add(table, plane_through({-r, -r, 0}, {r, -r, 0}, {r, r, 1}));
  const PlaneId x = add(table, plane_through({7, 0, 0}, {7, 1, 0}, {7, 0, 1}));
  const Point p = meet(table, flat, tilted, x, {});
  ASSERT_TRUE(p.is_lattice());
  EXPECT_EQ(p.lattice(), (GridPoint{7, -r, 0}));
  EXPECT_EQ(side(lattice_point({7, -r + 1, 0}), tilted, table), -1);
  EXPECT_EQ(side(lattice_point({7, -r - 1, 0}), tilted, table), 1);
}

TEST(Plane, CanonicalFormIsTheSameForAllTriplesOfItsPoints) {
  Random random(7);
  PlaneTable table;
  for (int i = 0; i < 200; ++i) {
    const GridPoint o = random.grid_point(1000);
    const GridPoint u = random.grid_point(1000);
    const GridPoint v = random.grid_point(1000);
    const auto at = [&](int s, int t) {
      return GridPoint{o.x + s * u.x + t * v.x, o.y + s * u.y + t * v.y, o.z + s * u.z + t * v.z};
    };
    const Plane first = plane_through(at(0, 0), at(1, 0), at(0, 1));
    if (is_null(first)) continue;
    const auto a = table.intern(first);
    const auto b = table.intern(plane_through(at(3, -2), at(5, 7), at(-4, 1)));
    const auto c = table.intern(plane_through(at(0, 1), at(1, 0), at(0, 0)));
    EXPECT_EQ(a.id, b.id);
    EXPECT_EQ(a.id, c.id);
    EXPECT_NE(a.turned, c.turned);
  }
}

}  // namespace
}  // namespace meshrepair
