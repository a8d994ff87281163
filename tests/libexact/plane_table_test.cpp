// SPDX-License-Identifier: MIT
#include <array>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <exact/plane_table.h>
#include <exact/predicates.h>

#include "random_geometry.h"

namespace meshrepair {
namespace {

using testing::Random;

Plane plane_near_origin(Random& random, std::int32_t radius) {
  Plane plane;
  do {
    plane = plane_through(random.grid_point(radius), random.grid_point(radius),
                          random.grid_point(radius));
  } while (is_null(plane));
  return plane;
}

Plane times(const Plane& p, std::int64_t factor) {
  return make_plane({p.normal[0] * factor, p.normal[1] * factor, p.normal[2] * factor},
                    p.offset * factor);
}

TEST(PlaneTable, CoplanarIsTheSameIdAndNothingElseIs) {
  Random random(1);
  PlaneTable table;
  std::map<std::array<std::int64_t, 4>, PlaneId> seen;
  int again = 0;
  for (int i = 0; i < 5000; ++i) {
    Plane plane = plane_near_origin(random, 3);
    const PlaneTable::Interned interned = table.intern(plane);
    const bool turned = make_canonical(plane);
    EXPECT_EQ(interned.turned, turned);
    const std::array<std::int64_t, 4> key = {plane.normal[0], plane.normal[1], plane.normal[2],
                                             static_cast<std::int64_t>(plane.offset)};
    const auto [place, fresh] = seen.try_emplace(key, interned.id);
    EXPECT_EQ(place->second, interned.id);
    again += !fresh;
  }
  EXPECT_EQ(table.size(), seen.size());
  EXPECT_GT(again, 500);
}

TEST(PlaneTable, IdsCountUpFromZero) {
  PlaneTable table;
  for (std::uint32_t i = 0; i < 100; ++i) {
    EXPECT_EQ(table.intern(make_plane({1, 0, 0}, i)).id, PlaneId(i));
  }
  EXPECT_EQ(table.size(), 100u);
  EXPECT_TRUE(table.contains(PlaneId(99u)));
  EXPECT_FALSE(table.contains(PlaneId(100u)));
  EXPECT_FALSE(table.contains(PlaneId()));
}

TEST(PlaneTable, MultiplesOfAPlaneAreThatPlane) {
  Random random(2);
  PlaneTable table;
  for (int i = 0; i < 500; ++i) {
    const Plane plane = plane_near_origin(random, 1000);
    const auto once = table.intern(plane);
    const auto twice = table.intern(times(plane, 6));
    const auto round = table.intern(times(plane, -35));
    EXPECT_EQ(once.id, twice.id);
    EXPECT_EQ(once.id, round.id);
    EXPECT_EQ(once.turned, twice.turned);
    EXPECT_NE(once.turned, round.turned);
  }
}

// 2 x = 1 passes between lattice points; it is not x = 0 nor x = 1.
TEST(PlaneTable, HalfIntegerOffsetsAreKept) {
  PlaneTable table;
  const auto half = table.intern(make_plane({2, 0, 0}, -1));
  const auto zero = table.intern(make_plane({2, 0, 0}, 0));
  const auto one = table.intern(make_plane({1, 0, 0}, -1));
  EXPECT_NE(half.id, zero.id);
  EXPECT_NE(half.id, one.id);
  EXPECT_EQ(side(GridPoint{0, 5, 5}, table[half.id]), -1);
  EXPECT_EQ(side(GridPoint{1, 5, 5}, table[half.id]), 1);
  EXPECT_EQ(table.intern(make_plane({-6, 0, 0}, 3)).id, half.id);
}

TEST(PlaneTable, ReleasingTheIndexForgetsNothing) {
  Random random(3);
  PlaneTable table;
  std::vector<std::pair<Plane, PlaneId>> all;
  for (int i = 0; i < 300; ++i) {
    const Plane plane = plane_near_origin(random, 50);
    all.emplace_back(plane, table.intern(plane).id);
    if (i % 37 == 0) table.release_index();
  }
  table.release_index();
  const std::size_t before = table.size();
  for (const auto& [plane, id] : all) EXPECT_EQ(table.intern(plane).id, id);
  EXPECT_EQ(table.size(), before);
}

TEST(PlaneTable, WhatWasInternedIsFound) {
  Random random(5);
  PlaneTable table;
  for (int i = 0; i < 300; ++i) {
    Plane plane = plane_near_origin(random, 50);
    make_canonical(plane);
    const PlaneId id = table.intern(plane).id;
    EXPECT_EQ(table.find(plane), id);
  }
  EXPECT_FALSE(table.find(make_plane({1000, 1, 1}, 7)).valid());
}

TEST(PlaneTable, TakesManyAtOnceAsOneByOne) {
  Random random(12);
  PlaneTable one_by_one, at_once;
  IdVector<PlaneId, Plane> planes;
  std::vector<PlaneId> wanted;
  for (int i = 0; i < 30'000; ++i) {
    Plane plane = plane_near_origin(random, 6);
    wanted.push_back(one_by_one.intern(plane).id);
    make_canonical(plane);
    planes.push_back(plane);
  }
  EXPECT_EQ(at_once.take(std::move(planes)), wanted);
  ASSERT_EQ(at_once.size(), one_by_one.size());
  for (PlaneId id(0u); id.index() < at_once.size(); ++id.value) {
    ASSERT_TRUE(same_coefficients(at_once[id], one_by_one[id]));
    ASSERT_EQ(at_once.intern(one_by_one[id]).id, id);
  }
}

// With a table of no planes, of few, of many, and one that has its index.
TEST(PlaneTable, InternsSeveralAsOneByOne) {
  Random random(6);
  for (const int known : {0, 10, 200'000}) {
    for (const bool has_index : {false, true}) {
      PlaneTable one_by_one, at_once;
      for (int i = 0; i < known; ++i) {
        const Plane plane = plane_near_origin(random, 12);
        one_by_one.intern(plane);
        at_once.intern(plane);
      }
      if (!has_index) at_once.release_index();
      std::vector<Plane> planes;
      for (int i = 0; i < 3000; ++i) planes.push_back(plane_near_origin(random, i % 2 ? 3 : 20));
      const std::vector<PlaneTable::Interned> interned = at_once.intern(planes);
      ASSERT_EQ(interned.size(), planes.size());
      for (std::size_t i = 0; i < planes.size(); ++i) {
        const PlaneTable::Interned expected = one_by_one.intern(planes[i]);
        ASSERT_EQ(interned[i].id, expected.id);
        ASSERT_EQ(interned[i].turned, expected.turned);
      }
      ASSERT_EQ(at_once.size(), one_by_one.size());
      for (PlaneId id(0u); id.index() < at_once.size(); ++id.value) {
        ASSERT_TRUE(same_coefficients(at_once[id], one_by_one[id]));
      }
      EXPECT_EQ(at_once.intern(planes[0]).id, interned[0].id);
    }
  }
}

TEST(PlaneTable, AppendedPlanesGetIdsOfTheirOwn) {
  PlaneTable table;
  const Plane plane = make_plane({1, 2, 3}, 4);
  const PlaneId first = table.append(plane);
  const PlaneId second = table.append(plane);
  EXPECT_NE(first, second);
  EXPECT_EQ(table.size(), 2u);
}

TEST(PlaneTable, StoredPlaneSeparatesPointsAsTheGivenOneDid) {
  Random random(4);
  PlaneTable table;
  for (int i = 0; i < 2000; ++i) {
    const Plane plane = plane_near_origin(random, kGridRadius);
    const auto interned = table.intern(plane);
    const GridPoint p = random.grid_point();
    EXPECT_EQ(side(p, plane), (interned.turned ? -1 : 1) * side(p, table[interned.id]));
  }
}

TEST(PlaneTable, LargestCoefficientsAreExact) {
  const std::int32_t r = kGridRadius;
  PlaneTable table;
  const Plane plane = plane_through({-r, -r, r}, {r, -r, -r + 1}, {-r + 1, r, -r});
  const auto interned = table.intern(plane);
  EXPECT_EQ(side(GridPoint{-r, -r, r}, table[interned.id]), 0);
  EXPECT_EQ(side(GridPoint{r, -r, -r + 1}, table[interned.id]), 0);
  EXPECT_EQ(side(GridPoint{-r + 1, r, -r}, table[interned.id]), 0);
  EXPECT_NE(side(GridPoint{-r + 1, r, -r + 1}, table[interned.id]), 0);
}

}  // namespace
}  // namespace meshrepair
