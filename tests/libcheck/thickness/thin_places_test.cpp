// SPDX-License-Identifier: MIT
// Thin walls, pins, gaps and edges of shapes whose thickness is known.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <base/error.h>
#include <base/parallel.h>
#include <check/thin_places.h>
#include <mesh/mesh_parts.h>

#include "shapes.h"

namespace meshrepair {
namespace {

using namespace testing;

ThinReport thin(const TriangleSoup& soup, double limit) {
  ThinOptions options;
  options.limit = limit;
  options.mark_triangles = true;
  return find_thin_places(soup, options);
}

std::array<std::size_t, kThinKinds> counts(const ThinReport& report) {
  std::array<std::size_t, kThinKinds> all{};
  for (std::size_t k = 0; k < kThinKinds; ++k) all[k] = report.kinds[k].count;
  return all;
}

constexpr std::array<std::size_t, kThinKinds> kNothing = {0, 0, 0, 0};
constexpr std::array<std::size_t, kThinKinds> kOneWall = {1, 0, 0, 0};
constexpr std::array<std::size_t, kThinKinds> kOnePin = {0, 1, 0, 0};
constexpr std::array<std::size_t, kThinKinds> kOneGap = {0, 0, 1, 0};

// A prism over a polygon in the plane of x and z, counter-clockwise as seen from -y.
TriangleSoup prism(const std::vector<std::array<double, 2>>& outline, double length) {
  TriangleSoup soup;
  const auto n = static_cast<std::uint32_t>(outline.size());
  for (const double y : {0.0, length}) {
    for (const auto& [x, z] : outline) soup.points.emplace_back(x, y, z);
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t k = (i + 1) % n;
    soup.triangles.push_back({i, k + n, k});
    soup.triangles.push_back({i, i + n, k + n});
    if (i == 0 || k == 0) continue;
    soup.triangles.push_back({0, i, k});
    soup.triangles.push_back({n, n + k, n + i});
  }
  return soup;
}

std::vector<std::array<double, 2>> circle(std::uint32_t sides, double radius) {
  std::vector<std::array<double, 2>> outline;
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double a = 2 * std::numbers::pi * i / sides;
    outline.push_back({radius * std::cos(a), radius * std::sin(a)});
  }
  return outline;
}

TriangleSoup wedge(double degrees) {
  const double rise = 10 * std::tan(degrees * std::numbers::pi / 180);
  return prism({{0, 0}, {10, 0}, {10, rise}}, 10);
}

TEST(ThinPlaces, PlateIsOneWall) {
  for (const std::uint64_t seed : {0u, 1u, 2u}) {
    TriangleSoup plate = box({0, 0, 0}, {10, 10, 1});
    if (seed > 0) plate = placed(plate, seed);
    const ThinReport report = thin(plate, 1.5);
    EXPECT_EQ(counts(report), kOneWall);
    EXPECT_NEAR(report[ThinKind::wall].first[0].thickness, 1, 1e-12);
    EXPECT_NEAR(report[ThinKind::wall].area, 200, 1e-9);
    EXPECT_NEAR(report.thin_area, 200, 1e-9);
    EXPECT_NEAR(report.area, 240, 1e-9);
    EXPECT_LE(report.spacing, 0.75);
  }
}

TEST(ThinPlaces, WhatIsAsThickAsTheLimitIsNotThin) {
  EXPECT_EQ(counts(thin(box({0, 0, 0}, {10, 10, 1}), 1)), kNothing);
}

TEST(ThinPlaces, CubeIsNowhereThinUpToItsSide) {
  for (const double limit : {0.01, 0.3, 1.0}) EXPECT_EQ(counts(thin(cube(), limit)), kNothing);
  for (const double limit : {1.01, 3.0, 1e6, 1e300}) {
    const ThinReport report = thin(cube(), limit);
    EXPECT_EQ(counts(report), kOnePin) << limit;
    EXPECT_DOUBLE_EQ(report[ThinKind::pin].first[0].thickness, 1);
    EXPECT_NEAR(report.thin_area, 6, 1e-12);
  }
}

TEST(ThinPlaces, ShellIsAsThickAsItsSpheresAreApart) {
  const TriangleSoup shell = together(sphere(20'000, 1), flipped(sphere(20'000, 0.95)));
  const ThinReport report = thin(shell, 0.06);
  EXPECT_EQ(counts(report), kOneWall);
  EXPECT_NEAR(report[ThinKind::wall].first[0].thickness, 0.05, 0.05 * 0.01);
  EXPECT_NEAR(report.thin_area, report.area, 1e-9);
  EXPECT_EQ(counts(thin(shell, 0.045)), kNothing);
}

TEST(ThinPlaces, HollowOfAShellIsAGap) {
  const TriangleSoup shell = together(sphere(5'000, 1), flipped(sphere(5'000, 0.2)));
  const ThinReport report = thin(shell, 0.5);
  EXPECT_EQ(counts(report), kOneGap);
  EXPECT_NEAR(report[ThinKind::gap].first[0].thickness, 0.4, 0.004);
}

TEST(ThinPlaces, TubeIsAsThickAsItsWall) {
  TriangleSoup tube = prism(circle(360, 10), 20);
  const TriangleSoup hole = flipped(prism(circle(360, 9), 20));
  // The ends of the two stay closed and coincide: they are left out.
  const auto is_end = [](const TriangleSoup& soup, const std::array<std::uint32_t, 3>& t) {
    return soup.points[t[0]].y() == soup.points[t[1]].y() &&
           soup.points[t[0]].y() == soup.points[t[2]].y();
  };
  append(tube, hole);
  std::erase_if(tube.triangles, [&](const auto& t) { return is_end(tube, t); });
  const ThinReport report = thin(tube, 2);
  EXPECT_EQ(counts(report), kOneWall);
  EXPECT_NEAR(report[ThinKind::wall].first[0].thickness, 1, 0.01);
  EXPECT_NEAR(report.thin_area / report.area, 1, 1e-9);
}

TEST(ThinPlaces, PinIsThinBothWays) {
  for (const std::uint32_t sides : {4U, 6U, 64U}) {
    const double inner = std::cos(std::numbers::pi / sides);  // radius of the inscribed circle
    const ThinReport report = thin(placed(prism(circle(sides, 1), 20), 7), 3.5);
    EXPECT_EQ(counts(report), kOnePin) << sides;
    EXPECT_NEAR(report[ThinKind::pin].first[0].thickness, 2 * inner, 2 * inner * 0.01) << sides;
  }
}

TEST(ThinPlaces, StripWiderThanFourTimesItsThicknessIsAWall) {
  EXPECT_EQ(counts(thin(box({0, 0, 0}, {20, 3, 1}), 3.5)), kOnePin);
  EXPECT_EQ(counts(thin(box({0, 0, 0}, {20, 5, 1}), 6)), kOneWall);
}

TEST(ThinPlaces, SlenderWedgeIsThinNearItsTip) {
  const ThinReport report = thin(wedge(10), 0.5);
  EXPECT_EQ(counts(report), kOneWall);
  const ThinPlace& place = report[ThinKind::wall].first[0];
  EXPECT_LT(place.at.x(), 0.5);
  EXPECT_LT(place.thickness, 0.1);
  // The ball of this diameter touches at this distance from the tip.
  const double reach = 0.25 / std::tan(5 * std::numbers::pi / 180);
  EXPECT_NEAR(report.thin_area, 2 * 10 * reach, 0.05 * 20 * reach);
}

TEST(ThinPlaces, WedgeOfAMiddleAngleIsASharpEdge) {
  const auto found = counts(thin(wedge(45), 0.5));
  EXPECT_EQ(found, (std::array<std::size_t, kThinKinds>{0, 0, 0, 2}));  // of 45 degrees each
  EXPECT_EQ(counts(thin(placed(prism(circle(5, 10), 10), 3), 0.5)), kNothing);
}

// Two of its faces would make a wedge, were there none between them.
TEST(ThinPlaces, FacesOfABarAreNoEdges) {
  for (const std::uint32_t sides : {5U, 6U, 8U, 12U, 16U, 24U, 32U}) {
    const double across = 2 * std::cos(std::acos(-1.0) / sides);
    SCOPED_TRACE(sides);
    EXPECT_EQ(counts(thin(placed(prism(circle(sides, 1), 6), sides), 0.93 * across)), kNothing);
  }
}

TEST(ThinPlaces, GapBetweenTwoBoxesIsOne) {
  const TriangleSoup soup = together(box({0, 0, 0}, {3, 3, 1}), box({1, 1, 1.25}, {2, 2, 3}));
  const ThinReport report = thin(soup, 0.5);
  EXPECT_EQ(counts(report), kOneGap);
  EXPECT_DOUBLE_EQ(report[ThinKind::gap].first[0].thickness, 0.25);
  EXPECT_GT(report[ThinKind::gap].area, 2);
}

TEST(ThinPlaces, WhatIsInTheWayIsSeen) {
  // Between two plates a third one: no gap from the first to the last.
  const TriangleSoup soup = together(together(box({0, 0, 0}, {9, 9, 2}), box({0, 0, 5}, {9, 9, 7})),
                                     box({-5, -5, 3}, {15, 15, 4.5}));
  const ThinReport report = thin(soup, 1.25);
  EXPECT_EQ(report[ThinKind::gap].count, 2U);
  EXPECT_DOUBLE_EQ(report[ThinKind::gap].first[0].thickness, 0.5);
  EXPECT_DOUBLE_EQ(report[ThinKind::gap].first[1].thickness, 1);
}

TEST(ThinPlaces, SeveralPlacesAreToldThinnestFirst) {
  const TriangleSoup soup = together(box({0, 0, 0}, {9, 9, 1}), box({20, 0, 0}, {29, 9, 0.5}));
  ThinOptions options;
  options.limit = 2;
  const ThinPlaces walls = find_thin_places(soup, options)[ThinKind::wall];
  ASSERT_EQ(walls.first.size(), 2U);
  EXPECT_DOUBLE_EQ(walls.first[0].thickness, 0.5);
  EXPECT_GE(walls.first[0].at.x(), 20);
  EXPECT_DOUBLE_EQ(walls.first[1].thickness, 1);
  EXPECT_NEAR(walls.first[1].area, 162, 1e-9);
  options.most_places = 1;
  const ThinPlaces one = find_thin_places(soup, options)[ThinKind::wall];
  EXPECT_EQ(one.count, 2U);
  EXPECT_EQ(one.first.size(), 1U);
  EXPECT_EQ(one.area, walls.area);
}

TEST(ThinPlaces, PartOfALargeFaceIsFound) {
  // A thin web joins two blocks; its faces are flush with nothing.
  const TriangleSoup soup = prism({{0, 0},
                                   {10, 0},
                                   {10, 4.5},
                                   {12, 4.5},
                                   {12, 0},
                                   {22, 0},
                                   {22, 10},
                                   {12, 10},
                                   {12, 5.5},
                                   {10, 5.5},
                                   {10, 10},
                                   {0, 10}},
                                  10);
  TriangleSoup sides = soup;
  std::erase_if(sides.triangles, [&](const auto& t) {  // the ends are no fans
    return soup.points[t[0]].y() == soup.points[t[1]].y() &&
           soup.points[t[0]].y() == soup.points[t[2]].y();
  });
  const ThinReport report = thin(sides, 1.5);
  EXPECT_EQ(counts(report), kOneWall);
  EXPECT_NEAR(report[ThinKind::wall].first[0].thickness, 1, 1e-12);
  EXPECT_NEAR(report[ThinKind::wall].area, 40, 1e-9);
}

void expect_same(const ThinReport& a, const ThinReport& b, double scale, const Vec3d& moved) {
  EXPECT_EQ(counts(a), counts(b));
  EXPECT_EQ(a.spacing * scale, b.spacing);
  EXPECT_EQ(a.thin_area * scale * scale, b.thin_area);
  for (std::size_t k = 0; k < kThinKinds; ++k) {
    ASSERT_EQ(a.kinds[k].first.size(), b.kinds[k].first.size());
    for (std::size_t i = 0; i < a.kinds[k].first.size(); ++i) {
      const ThinPlace &p = a.kinds[k].first[i], &q = b.kinds[k].first[i];
      EXPECT_EQ(p.thickness * scale, q.thickness);
      EXPECT_EQ(p.area * scale * scale, q.area);
      EXPECT_TRUE(Vec3d(p.at * scale + moved).isApprox(q.at, 1e-12));
    }
  }
}

// Coordinates of few bits, so that moving them rounds nothing.
TriangleSoup coarse(TriangleSoup soup) {
  for (Vec3d& p : soup.points) p = (p * 1024).array().round().matrix() / 1024;
  return soup;
}

TriangleSoup uneven_shell() {
  return coarse(together(sphere(3'000, 8), flipped(sphere(3'000, 7, {0.6, 0.1, 0.2}))));
}

TEST(ThinPlaces, SameForAnyNumberOfThreads) {
  const TriangleSoup soup = uneven_shell();
  const ThinReport all = thin(soup, 0.75);
  const ThreadLimit limit(1);
  const ThinReport one = thin(soup, 0.75);
  expect_same(all, one, 1, Vec3d::Zero());
  EXPECT_EQ(all.marks, one.marks);
}

TEST(ThinPlaces, SameForAnyOrderOfTrianglesAndCorners) {
  const TriangleSoup soup = uneven_shell();
  TriangleSoup other = soup;
  std::reverse(other.triangles.begin(), other.triangles.end());
  for (std::size_t t = 0; t < other.triangles.size(); ++t) {
    auto& corners = other.triangles[t];
    std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(t % 3),
                corners.end());
  }
  const ThinReport a = thin(soup, 0.75), b = thin(other, 0.75);
  expect_same(a, b, 1, Vec3d::Zero());
  EXPECT_TRUE(std::equal(a.marks.begin(), a.marks.end(), b.marks.rbegin()));
}

TEST(ThinPlaces, SameIfScaledByTwoAndIfMoved) {
  const TriangleSoup soup = uneven_shell();
  const ThinReport before = thin(soup, 0.75);
  expect_same(before, thin(scaled(soup, 2), 1.5), 2, Vec3d::Zero());
  expect_same(before, thin(scaled(soup, 0x1p-400), 0.75 * 0x1p-400), 0x1p-400, Vec3d::Zero());
  EXPECT_EQ(counts(before), counts(thin(moved(soup, {4096, -512, 64}), 0.75)));
}

TEST(ThinPlaces, LimitMayBeAShareOfTheDiagonal) {
  ThinOptions options;
  options.limit = 0.5;
  options.is_share = true;
  const ThinReport report = find_thin_places(box({0, 0, 0}, {2, 2, 1}), options);
  EXPECT_DOUBLE_EQ(report.limit, 1.5);
  EXPECT_EQ(counts(report), kOneWall);
}

TEST(ThinPlaces, WhatIsNoTriangleIsLeftOut) {
  TriangleSoup soup = box({0, 0, 0}, {10, 10, 1});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  soup.points.emplace_back(nan, 0, 0);
  soup.points.emplace_back(0, infinite, 0);
  soup.points.emplace_back(1e300, 1e300, 1e300);  // of no triangle
  soup.triangles.push_back({0, 1, 8});
  soup.triangles.push_back({0, 1, 9});
  soup.triangles.push_back({0, 1, 1});
  EXPECT_EQ(counts(thin(soup, 1.5)), kOneWall);
  EXPECT_EQ(counts(thin({}, 1.5)), kNothing);
  EXPECT_EQ(counts(thin({{{0, 0, 0}, {1, 0, 0}}, {{0, 1, 1}}}, 1.5)), kNothing);
}

TEST(ThinPlaces, FacesThatCoincideAreNotThin) {
  const TriangleSoup soup = together(box({0, 0, 0}, {3, 3, 3}), box({0, 0, 3}, {3, 3, 6}));
  EXPECT_EQ(counts(thin(soup, 1)), kNothing);
}

class Canceller : public ProgressObserver {
 public:
  bool cancelled() override { return true; }
};

TEST(ThinPlaces, MayBeCancelled) {
  Canceller canceller;
  ThinOptions options;
  options.limit = 1;
  options.progress = &canceller;
  EXPECT_THROW((void)find_thin_places(cube(), options), Cancelled);
}

TEST(ThinPlaces, FoldedSliversAreNoPlaces) {
  // In the upper side of a cube, a sliver whose corner is rounded across its long side.
  TriangleSoup soup = box({0, 0, 0}, {10, 10, 10});
  const auto first = static_cast<std::uint32_t>(soup.points.size());
  soup.points.emplace_back(2, 5, 10);
  soup.points.emplace_back(8, 5, 10);
  soup.points.emplace_back(5, 5 + 1e-9, 10 + 1e-9);
  soup.triangles.push_back({first, first + 2, first + 1});
  EXPECT_EQ(counts(thin(soup, 1)), kNothing);
  // Nor do they say how thin a wall is.
  for (Vec3d& p : soup.points) p.z() /= 16;
  const ThinReport report = thin(soup, 1);
  EXPECT_EQ(counts(report), kOneWall);
  EXPECT_DOUBLE_EQ(report[ThinKind::wall].first[0].thickness, 0.625);
}

TEST(ThinPlaces, LimitFarBelowTheSizeTakesNoLongTime) {
  const ThinReport report = thin(placed(box({0, 0, 0}, {1, 1, 1e-7}), 5), 2e-7);
  EXPECT_EQ(report[ThinKind::wall].count, 1U);
  EXPECT_NEAR(report[ThinKind::wall].first[0].thickness, 1e-7, 1e-9);
  EXPECT_GT(report.spacing, 1e-7);
  EXPECT_EQ(counts(thin(placed(cube(), 5), 1e-9)), kNothing);
}

}  // namespace
}  // namespace meshrepair
