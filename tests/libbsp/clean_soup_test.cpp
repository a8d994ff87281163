// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <base/error.h>
#include <bsp/clean_soup.h>
#include <exact/predicates.h>
#include <mesh/edge_table.h>

#include "degenerate_soups.h"
#include "each_seed.h"
#include "random_geometry.h"
#include "share_of_cases.h"

namespace meshrepair {
namespace {

using namespace testing;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TriangleSoup one_triangle() { return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}; }

void expect_consistent(const CleanSoup& clean, const CleanReport& report) {
  EXPECT_EQ(clean.triangles.size() + report.dropped_not_finite + report.dropped_degenerate +
                report.dropped_below_grid + report.duplicates + report.opposite_duplicates,
            report.triangles_in);
  EXPECT_EQ(clean.points.size(), clean.grid_points.size());
  const std::set<GridPoint> distinct(clean.grid_points.begin(), clean.grid_points.end());
  EXPECT_EQ(distinct.size(), clean.grid_points.size());
  std::set<std::set<PointId>> corner_sets;
  std::uint32_t last_source = 0;
  for (const Triangle& t : clean.triangles) {
    const std::array<GridPoint, 3> at = {clean.grid_points[t.corners[0]],
                                         clean.grid_points[t.corners[1]],
                                         clean.grid_points[t.corners[2]]};
    const Plane own = plane_through(at[0], at[1], at[2]);
    EXPECT_FALSE(is_null(own));
    for (const GridPoint& p : at) EXPECT_EQ(side(p, clean.planes[t.plane]), 0);
    if (t.winding != 0) {
      // `winding` says how the triangle's own normal stands to its plane's.
      double dot = 0;
      for (std::size_t i = 0; i < 3; ++i) dot += own.unit[i] * clean.planes[t.plane].unit[i];
      EXPECT_NEAR(dot, t.winding, 1e-9);
    }
    EXPECT_TRUE(corner_sets.insert({t.corners.begin(), t.corners.end()}).second);
    EXPECT_GE(t.source, last_source);
    last_source = t.source;
  }
}

TEST(CleanSoup, WhatIsKeptAndDroppedAddsUp) {
  for (const SoupFamily& family : degenerate_families()) {
    for_each_seed(20, [&](std::uint64_t seed) {
      SCOPED_TRACE(family.name + " " + std::to_string(seed));
      CleanReport report;
      const CleanSoup clean = clean_soup(family.make(seed), report);
      expect_consistent(clean, report);
      EXPECT_EQ(report.grid_unit, clean.grid.unit);
    });
  }
}

TEST(CleanSoup, SoundTrianglesStayAsTheyAre) {
  const TriangleSoup soup = sphere(300);
  CleanReport report;
  const CleanSoup clean = clean_soup(soup, report);
  ASSERT_EQ(clean.triangles.size(), soup.triangles.size());
  ASSERT_EQ(clean.points.size(), soup.points.size());
  for (std::uint32_t p = 0; p < soup.points.size(); ++p) {
    EXPECT_EQ(clean.points[PointId(p)], soup.points[p]);
  }
  for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
    const Triangle& triangle = clean.triangles[TriangleId(t)];
    EXPECT_EQ(triangle.source, t);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(triangle.corners[k].value, soup.triangles[t][k]);
    }
  }
}

TEST(CleanSoup, TrianglesThatAreNotFiniteAreDroppedAndDoNotBendTheGrid) {
  TriangleSoup soup = one_triangle();
  CleanReport before;
  const Grid grid = clean_soup(soup, before).grid;
  soup.points.emplace_back(kNan, 0, 0);
  soup.points.emplace_back(0, kInfinity, 0);
  soup.points.emplace_back(0, 0, -kInfinity);
  soup.points.emplace_back(1e200, 0, 0);  // finite, but used with others that are not
  soup.triangles.push_back({0, 1, 3});
  soup.triangles.push_back({4, 6, 2});
  soup.triangles.push_back({5, 5, 5});
  CleanReport report;
  const CleanSoup clean = clean_soup(soup, report);
  EXPECT_EQ(report.dropped_not_finite, 3u);
  EXPECT_EQ(clean.triangles.size(), 1u);
  EXPECT_EQ(clean.points.size(), 3u);
  EXPECT_EQ(clean.grid.unit, grid.unit);
  EXPECT_EQ(clean.grid.origin, grid.origin);
  expect_consistent(clean, report);
}

TEST(CleanSoup, DegenerateTrianglesAreDropped) {
  TriangleSoup soup = one_triangle();
  soup.points.emplace_back(2, 0, 0);
  soup.points.emplace_back(0.5, 1e-12, 0);  // in a line with 0 and 1, once on the grid
  soup.triangles.push_back({0, 0, 1});
  soup.triangles.push_back({1, 1, 1});
  soup.triangles.push_back({0, 1, 3});
  soup.triangles.push_back({0, 1, 4});
  CleanReport report;
  const CleanSoup clean = clean_soup(soup, report);
  EXPECT_EQ(report.dropped_degenerate, 3u);
  EXPECT_EQ(report.dropped_below_grid, 1u);
  EXPECT_EQ(clean.triangles.size(), 1u);
  expect_consistent(clean, report);
}

TEST(CleanSoup, WhatAFarPointMakesTooSmallIsToldFromWhatWasFlatBefore) {
  TriangleSoup soup = one_triangle();
  soup.points.emplace_back(0.1, 0.2, 0.3);  // in a line with 0, but for the rounding of decimals
  soup.points.emplace_back(0.3, 0.6, 0.9);
  soup.triangles.push_back({0, 3, 4});
  soup.points.emplace_back(1e12, 0, 0);
  soup.triangles.push_back({0, 2, 5});
  CleanReport report;
  const CleanSoup clean = clean_soup(soup, report);
  EXPECT_EQ(report.dropped_below_grid, 2u);
  EXPECT_EQ(report.dropped_degenerate, 1u);
  EXPECT_EQ(clean.triangles.size(), 0u);
  expect_consistent(clean, report);
}

TEST(CleanSoup, FlatnessDoesNotDependOnTheUnit) {
  for (const double unit : {0x1p-1060, 1.0, 0x1p+1000}) {
    TriangleSoup soup = {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 0x1p-40, 0}, {0, 1, 0}},
                         {{0, 1, 2}, {0, 3, 2}, {0, 1, 4}}};
    for (Vec3d& p : soup.points) p *= unit;
    CleanReport report;
    const CleanSoup clean = clean_soup(soup, report);
    EXPECT_EQ(clean.triangles.size(), 1u) << unit;
    EXPECT_EQ(report.dropped_degenerate, unit < 1 ? 2u : 1u) << unit;  // 2^-1100 is 0
    expect_consistent(clean, report);
  }
}

TEST(CleanSoup, CopiesAreOneTriangle) {
  TriangleSoup soup = one_triangle();
  soup.triangles.push_back({1, 2, 0});
  soup.triangles.push_back({2, 0, 1});
  CleanReport report;
  const CleanSoup clean = clean_soup(soup, report);
  EXPECT_EQ(report.duplicates, 2u);
  EXPECT_EQ(report.opposite_duplicates, 0u);
  ASSERT_EQ(clean.triangles.size(), 1u);
  EXPECT_NE(clean.triangles[TriangleId(0u)].winding, 0);
}

// Two tetrahedra on the same side of it.
TEST(CleanSoup, AFaceOfTwoSolidsIsTwoLayers) {
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5, 0.5, 2}};
  for (const std::uint32_t top : {3u, 4u}) {
    soup.triangles.insert(soup.triangles.end(), {{0, 2, 1}, {0, 1, top}, {1, 2, top}, {2, 0, top}});
  }
  for (const bool listed_again : {false, true}) {
    if (listed_again) soup.triangles.push_back({1, 2, 3});
    CleanReport report;
    const CleanSoup clean = clean_soup(soup, report);
    EXPECT_EQ(report.duplicates, listed_again ? 2u : 1u);
    ASSERT_EQ(clean.triangles.size(), 7u);
    for (const Triangle& t : clean.triangles) {
      EXPECT_EQ(t.layers, t.source == 0 ? 2 : 1) << t.source;
      EXPECT_EQ(std::abs(t.winding), 1) << t.source;
    }
  }
}

// Of each edge, how much more often it is passed one way than the other; all together.
std::int64_t imbalance(const CleanSoup& clean, const std::vector<int>& facings) {
  std::map<std::pair<PointId, PointId>, std::int64_t> passes;
  for (std::size_t t = 0; t < facings.size(); ++t) {
    const auto& corners = clean.triangles[TriangleId(t)].corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const PointId a = corners[k], b = corners[(k + 1) % 3];
      passes[std::minmax(a, b)] += a < b ? facings[t] : -facings[t];
    }
  }
  std::int64_t sum = 0;
  for (const auto& [edge, more] : passes) sum += std::abs(more);
  return sum;
}

// Of triangles whose copies are at the very same place: whether any is turned as it is, and the
// other way.
std::vector<int> facings_as_one(const CleanSoup& clean, const TriangleSoup& soup) {
  std::vector<int> facings;
  for (const Triangle& t : clean.triangles) {
    const IndexTriangle own = soup.triangles[t.source];
    bool same = false, opposite = false;
    for (const IndexTriangle& other : soup.triangles) {
      if (!std::is_permutation(own.begin(), own.end(), other.begin())) continue;
      const auto at =
          static_cast<std::size_t>(std::find(other.begin(), other.end(), own[0]) - other.begin());
      (other[(at + 1) % 3] == own[1] ? same : opposite) = true;
    }
    facings.push_back((same ? 1 : 0) - (opposite ? 1 : 0));
  }
  return facings;
}

std::vector<int> facings_as_counted(const CleanSoup& clean) {
  std::vector<int> facings;
  for (const Triangle& t : clean.triangles) {
    const auto& at = clean.grid_points;
    const Plane own = plane_through(at[t.corners[0]], at[t.corners[1]], at[t.corners[2]]);
    double dot = 0;
    for (std::size_t i = 0; i < 3; ++i) dot += own.unit[i] * clean.planes[t.plane].unit[i];
    facings.push_back((dot > 0 ? 1 : -1) * t.winding * t.layers);
  }
  return facings;
}

// Many of its triangles are there more than once.
TriangleSoup triangles_of_five_points(std::uint64_t seed) {
  Random random(seed);
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 2, 3}};
  for (int i = 0; i < 14; ++i) {
    IndexTriangle t{};
    for (std::uint32_t& corner : t) corner = static_cast<std::uint32_t>(random.integer(0, 4));
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) soup.triangles.push_back(t);
  }
  return soup;
}

TEST(CleanSoup, CopiesCountOnlyWhereThatBalancesEdges) {
  std::size_t counted = 0;
  for_each_seed(2000, [&](std::uint64_t seed) {
    const TriangleSoup soup = triangles_of_five_points(seed);
    CleanReport report;
    const CleanSoup clean = clean_soup(soup, report);
    const std::vector<int> as_one = facings_as_one(clean, soup);
    const std::vector<int> as_counted = facings_as_counted(clean);
    if (as_counted == as_one) return;
    ++counted;
    expect_consistent(clean, report);
    EXPECT_LT(imbalance(clean, as_counted), imbalance(clean, as_one));
  });
  EXPECT_GT(counted, expected_cases(30u));
}

// A double wall has no outside: one copy is enough to know, and more of one kind do not outweigh
// it.
TEST(CleanSoup, OppositeCopiesHaveNoWinding) {
  for (const std::array<std::uint32_t, 3> turned :
       {std::array<std::uint32_t, 3>{0, 2, 1}, std::array<std::uint32_t, 3>{2, 1, 0},
        std::array<std::uint32_t, 3>{1, 0, 2}}) {
    TriangleSoup soup = one_triangle();
    soup.triangles.push_back(turned);
    soup.triangles.push_back({0, 1, 2});
    CleanReport report;
    const CleanSoup clean = clean_soup(soup, report);
    EXPECT_EQ(report.duplicates, 1u);
    EXPECT_EQ(report.opposite_duplicates, 1u);
    ASSERT_EQ(clean.triangles.size(), 1u);
    EXPECT_EQ(clean.triangles[TriangleId(0u)].winding, 0);
  }
}

// Layers nearer to each other than the grid can tell: what a walk through all of them meets.
TEST(CleanSoup, NearLayersAddUp) {
  for (const auto& [facing, sum] : std::vector<std::pair<std::vector<int>, int>>{
           {{1, -1, 1}, 1}, {{-1, 1, 1}, 1}, {{1, -1}, 0}, {{-1, 1, -1, 1, -1}, -1}, {{1, 1}, 1}}) {
    TriangleSoup soup;
    for (const int facing_up : facing) {
      const auto first = static_cast<std::uint32_t>(soup.points.size());
      const double z = 1e-10 * static_cast<double>(soup.triangles.size());
      for (const Vec3d& p : {Vec3d(0, 0, z), Vec3d(1, 0, z), Vec3d(0, 1, z)}) {
        soup.points.push_back(p);
      }
      soup.triangles.push_back({first, first + 1, first + 2});
      if (facing_up < 0) std::swap(soup.triangles.back()[0], soup.triangles.back()[1]);
    }
    CleanReport report;
    const CleanSoup clean = clean_soup(soup, report);
    ASSERT_EQ(clean.triangles.size(), 1u);
    const Triangle& triangle = clean.triangles[TriangleId(0u)];
    const int plane_is_up = clean.planes[triangle.plane].unit[2] > 0 ? 1 : -1;
    EXPECT_EQ(triangle.winding * plane_is_up, sum);
  }
}

TEST(CleanSoup, NegativeZeroIsNoNewPoint) {
  TriangleSoup soup = one_triangle();
  soup.points.emplace_back(-0.0, 0.0, -0.0);
  soup.points.emplace_back(0, 0, 1);
  soup.triangles.push_back({3, 1, 4});
  CleanReport report;
  const CleanSoup clean = clean_soup(soup, report);
  EXPECT_EQ(report.joined_points, 0u);
  EXPECT_EQ(clean.points.size(), 4u);
}

TEST(CleanSoup, PointsOfOneGridPointAreJoined) {
  TriangleSoup soup = one_triangle();
  soup.points.emplace_back(1e-12, 0, 0);
  soup.points.emplace_back(0, 0, 1);
  soup.triangles.push_back({3, 1, 4});
  CleanReport report;
  const CleanSoup clean = clean_soup(soup, report);
  EXPECT_EQ(report.joined_points, 1u);
  ASSERT_EQ(clean.points.size(), 4u);
  EXPECT_EQ(clean.points[PointId(0u)], Vec3d(0, 0, 0));
  EXPECT_EQ(clean.triangles[TriangleId(1u)].corners[0], clean.triangles[TriangleId(0u)].corners[0]);
}

TEST(CleanSoup, UnusedPointsPlayNoPart) {
  TriangleSoup soup = one_triangle();
  soup.points.insert(soup.points.begin(), {{1e30, 0, 0}, {kNan, 0, 0}});
  for (auto& corner : soup.triangles[0]) corner += 2;
  CleanReport report;
  const CleanSoup clean = clean_soup(soup, report);
  CleanReport expected_report;
  const CleanSoup expected = clean_soup(one_triangle(), expected_report);
  EXPECT_EQ(clean.grid.unit, expected.grid.unit);
  EXPECT_EQ(clean.grid_points.raw(), expected.grid_points.raw());
}

TEST(CleanSoup, IndexOutOfRangeIsRefusedByName) {
  TriangleSoup soup = one_triangle();
  soup.triangles.push_back({0, 3, 1});
  CleanReport report;
  try {
    (void)clean_soup(soup, report);
    FAIL() << "was not refused";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("triangle 1"), std::string::npos) << error.what();
  }
  soup.triangles = {{0, 1, ~std::uint32_t{0}}};
  EXPECT_THROW((void)clean_soup(soup, report), InputError);
  EXPECT_THROW((void)clean_soup({{}, {{0, 0, 0}}}, report), InputError);
}

TEST(CleanSoup, NothingIsCleanedToNothing) {
  for (const TriangleSoup& soup :
       {TriangleSoup{}, TriangleSoup{{{1, 2, 3}}, {}}, TriangleSoup{{{1, 2, 3}}, {{0, 0, 0}}},
        TriangleSoup{{{kNan, 2, 3}}, {{0, 0, 0}}}}) {
    CleanReport report;
    const CleanSoup clean = clean_soup(soup, report);
    EXPECT_TRUE(clean.triangles.empty());
    expect_consistent(clean, report);
    const GridBox box = outer_box(clean);
    EXPECT_LT(box.low.x, box.high.x);
  }
}

TEST(CleanSoup, ExtremeCoordinatesStayOnTheGrid) {
  const double most = std::numeric_limits<double>::max();
  const double least = std::numeric_limits<double>::denorm_min();
  for (const double size : {most, 1e300, 1e-300, 1e-310, least}) {
    SCOPED_TRACE(size);
    TriangleSoup soup = {{{-size, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}},
                         {{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
    CleanReport report;
    const CleanSoup clean = clean_soup(soup, report);
    EXPECT_EQ(clean.triangles.size(), 4u);
    for (const GridPoint& p : clean.grid_points) {
      for (const std::int32_t x : {p.x, p.y, p.z}) {
        EXPECT_GE(x, -kGridRadius);
        EXPECT_LE(x, kGridRadius);
      }
    }
  }
}

TEST(OuterBox, HoldsEveryPointStrictly) {
  for (const SoupFamily& family : degenerate_families()) {
    SCOPED_TRACE(family.name);
    const CleanSoup clean = [&] {
      CleanReport report;
      return clean_soup(family.make(3), report);
    }();
    const GridBox box = outer_box(clean);
    for (const GridPoint& p : clean.grid_points) {
      EXPECT_TRUE(box.low.x < p.x && p.x < box.high.x);
      EXPECT_TRUE(box.low.y < p.y && p.y < box.high.y);
      EXPECT_TRUE(box.low.z < p.z && p.z < box.high.z);
    }
  }
}

}  // namespace
}  // namespace meshrepair
