// SPDX-License-Identifier: MIT
// Open edges that nearly meet.
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <mesh/topology.h>
#include <repair/repair.h>
#include <repair/sew_soup.h>

#include "each_seed.h"
#include "shapes.h"

namespace meshrepair {
namespace {

using namespace testing;

constexpr SewOptions kAutomatic = {SewMode::automatic, 0, false, nullptr};

// Each triangle with corners of its own, moved by at most so much along each axis.
TriangleSoup torn(const TriangleSoup& soup, double noise, std::uint64_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> real(-noise, noise);
  TriangleSoup apart;
  for (const auto& t : soup.triangles) {
    const auto first = static_cast<std::uint32_t>(apart.points.size());
    for (const std::uint32_t p : t) {
      apart.points.push_back(soup.points[p] + Vec3d(real(random), real(random), real(random)));
    }
    apart.triangles.push_back({first, first + 1, first + 2});
  }
  return apart;
}

RepairReport report_of(const TriangleSoup& soup, Surface* surface = nullptr) {
  RepairOptions options;
  options.sew.mode = SewMode::automatic;
  RepairReport report;
  Surface result = repair(soup, options, report);
  if (surface != nullptr) *surface = std::move(result);
  return report;
}

TEST(SewSoup, TornTorusIsATorusAgain) {
  const TriangleSoup whole = torus(60, 30);
  for (const double noise : {1e-9, 1e-7, 1e-5, 1e-3, 5e-3}) {
    Surface surface;
    const RepairReport report = report_of(torn(whole, noise, 1), &surface);
    EXPECT_EQ(report.output.triangles, whole.triangles.size()) << noise;
    EXPECT_EQ(surface.mesh.points.size(), whole.points.size()) << noise;
    EXPECT_TRUE(report.output.closed() && report.output.manifold() && report.output.oriented());
    EXPECT_EQ(report.sew.sewn_edges, 3 * whole.triangles.size());
    EXPECT_LE(report.sew.farthest_move, 2 * std::sqrt(3) * noise);
    EXPECT_EQ(report.triangles.untouched, 0u);
    EXPECT_EQ(std::count(surface.input_point.begin(), surface.input_point.end(), 1), 0);
  }
}

// Two halves whose rims have different points.
TriangleSoup cracked_cylinder(std::uint32_t below, std::uint32_t above, double gap) {
  TriangleSoup soup;
  const auto half = [&](std::uint32_t sides, double rim, double end) {
    const auto first = static_cast<std::uint32_t>(soup.points.size());
    for (std::uint32_t i = 0; i < sides; ++i) {
      // Rims are on one polygon: the corners of a square and points between them.
      const double along = 4.0 * i / sides;
      const auto k = static_cast<int>(along);
      const double share = along - k;
      const std::array<Vec3d, 5> square = {Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(-1, 0, 0),
                                           Vec3d(0, -1, 0), Vec3d(1, 0, 0)};
      const Vec3d at = (1 - share) * square[static_cast<std::size_t>(k)] +
                       share * square[static_cast<std::size_t>(k) + 1];
      soup.points.push_back(at + Vec3d(0, 0, rim));
      soup.points.push_back(at + Vec3d(0, 0, end));
    }
    const auto middle = static_cast<std::uint32_t>(soup.points.size());
    soup.points.emplace_back(0, 0, end);
    for (std::uint32_t i = 0; i < sides; ++i) {
      const std::uint32_t a = first + 2 * i, b = first + 2 * ((i + 1) % sides);
      const bool up = end > rim;
      soup.triangles.push_back({a, up ? b : b + 1, up ? b + 1 : b});
      soup.triangles.push_back({a, up ? b + 1 : a + 1, up ? a + 1 : b + 1});
      soup.triangles.push_back({middle, up ? a + 1 : b + 1, up ? b + 1 : a + 1});
    }
  };
  half(below, 0, -1);
  half(above, gap, 1);
  return soup;
}

TEST(SewSoup, RimsWithDifferentCornersAreZipped) {
  for (const auto& [below, above] : {std::pair(8u, 8u), {8u, 12u}, {4u, 20u}, {12u, 20u}}) {
    const RepairReport report = report_of(cracked_cylinder(below, above, 0.004));
    EXPECT_EQ(report.sew.sewn_edges, below + above) << below << ' ' << above;
    EXPECT_EQ(report.holes.closed, 0u);
    EXPECT_EQ(report.output.parts, 1u);
    EXPECT_NEAR(report.output_volume, 4, 0.02);
    EXPECT_LE(report.sew.farthest_move, 0.0041);
  }
}

TEST(SewSoup, HolesAreNotSewn) {
  TriangleSoup soup = sphere(2000);
  soup.triangles.erase(soup.triangles.begin() + 100, soup.triangles.begin() + 130);
  for (const TriangleSoup& open : {soup, without_some(sphere(2000), 0.1, 3),
                                   without_some(box({0, 0, 0}, {1, 2, 3}), 0.1, 1)}) {
    SewReport report;
    EXPECT_FALSE(sew_soup(open, kAutomatic, report));
    EXPECT_EQ(report.distance, 0);
    EXPECT_EQ(report.refused_distance, 0);
  }
}

TEST(SewSoup, NothingIsSewnOfWhatIsClosed) {
  SewReport report;
  EXPECT_FALSE(sew_soup(sphere(500), kAutomatic, report));
  EXPECT_EQ(report.open_edges, 0u);
}

TEST(SewSoup, ModeNoneSewsNothing) {
  SewReport report;
  EXPECT_FALSE(sew_soup(torn(sphere(500), 1e-4, 1), {SewMode::none, 0, false, nullptr}, report));
  EXPECT_FALSE(
      sew_soup(torn(sphere(500), 1e-4, 1), {SewMode::distance, 0, false, nullptr}, report));
  EXPECT_TRUE(
      sew_soup(torn(sphere(500), 1e-4, 1), {SewMode::distance, 1e-3, false, nullptr}, report));
}

TEST(SewSoup, TheWidestGapIsMeasuredAndNotWhatWasAskedFor) {
  for (const double noise : {1e-5, 1e-3}) {
    SewReport report;
    ASSERT_TRUE(
        sew_soup(torn(torus(60, 30), noise, 1), {SewMode::distance, 0.02, false, nullptr}, report));
    EXPECT_EQ(report.distance, 0.02);
    EXPECT_GT(report.widest_gap, noise);
    EXPECT_LE(report.widest_gap, 2 * std::sqrt(3) * noise);
  }
}

TEST(SewSoup, ADistanceMayBeAShareOfTheDiagonal) {
  const TriangleSoup soup = torn(sphere(500), 1e-4, 1);
  SewReport report;
  ASSERT_TRUE(sew_soup(soup, {SewMode::distance, 0.001, true, nullptr}, report));
  EXPECT_NEAR(report.distance, 0.001 * 2 * std::sqrt(3), 1e-4);
}

TEST(SewSoup, OrderScaleAndPlaceDoNotMatter) {
  for_each_seed(10, [&](std::uint64_t seed) {
    const TriangleSoup given = torn(torus(20, 12), 1e-3, seed);
    SewReport report, other;
    const auto sewn = sew_soup(given, kAutomatic, report);
    ASSERT_TRUE(sewn);
    const auto large = sew_soup(scaled(given, 1024), kAutomatic, other);
    ASSERT_TRUE(large);
    EXPECT_EQ(other.distance, 1024 * report.distance);
    EXPECT_EQ(large->soup.points, scaled(sewn->soup, 1024).points);
    TriangleSoup reversed = given;
    std::reverse(reversed.triangles.begin(), reversed.triangles.end());
    const auto again = sew_soup(reversed, kAutomatic, other);
    ASSERT_TRUE(again);
    EXPECT_EQ(again->soup.points, sewn->soup.points);
  });
}

TEST(SewSoup, TrianglesThatAreNotFiniteDoNotKeepOthersFromBeingSewn) {
  TriangleSoup soup = torn(torus(20, 12), 1e-3, 1);
  const auto first = static_cast<std::uint32_t>(soup.points.size());
  for (int k = 0; k < 3; ++k) soup.points.push_back(Vec3d::Constant(std::nan("")));
  soup.triangles.push_back({first, first + 1, first + 2});
  SewReport report;
  ASSERT_TRUE(sew_soup(soup, kAutomatic, report));
  EXPECT_EQ(report.sewn_edges, report.open_edges);
}

// All corners are within such a distance of all others: not one pair after the other is looked at.
TEST(SewSoup, RefusesDistancesThatHoldEverything) {
  SewReport report;
  EXPECT_FALSE(
      sew_soup(torn(sphere(20000), 1e-4, 1), {SewMode::distance, 100, false, nullptr}, report));
  EXPECT_EQ(report.refused_distance, 100);
  EXPECT_EQ(report.joined_points, 0u);
}

// Where all corners are near thousands of edges, looking for the nearest takes most of the time.
TEST(SewSoup, AHeapOfTrianglesAsksOftenWhetherToGoOn) {
  struct Counter : ProgressObserver {
    bool cancelled() override {
      ++asked;
      return false;
    }
    int asked = 0;
  } counter;
  SewReport report;
  (void)sew_soup(torn(sphere(5000), 0.1, 1), {.mode = SewMode::automatic, .progress = &counter},
                 report);
  EXPECT_GT(counter.asked, 50);
}

// A soup of points anywhere, also where there are none to be had.
TEST(SewSoup, RandomSoupsAreSewnOrLeft) {
  for_each_seed(200, [&](std::uint64_t seed) {
    TriangleSoup soup = random_soup(1 + seed % 40, 3 + static_cast<std::int32_t>(seed % 5), seed);
    if (seed % 3 == 0) soup = torn(soup, 0.01, seed);
    if (seed % 7 == 0) soup.points[seed % soup.points.size()] = Vec3d::Constant(std::nan(""));
    for (const SewOptions& options : {kAutomatic,
                                      SewOptions{SewMode::distance, 0.5, false, nullptr},
                                      {SewMode::distance, 1e9, false, nullptr}}) {
      SewReport report;
      const auto sewn = sew_soup(soup, options, report);
      if (!sewn) continue;
      ASSERT_EQ(sewn->source.size(), sewn->soup.triangles.size());
      EXPECT_GT(report.joined_points + report.split_edges, 0u);
      for (const auto& t : sewn->soup.triangles) {
        for (const std::uint32_t p : t) ASSERT_LT(p, sewn->soup.points.size());
      }
      EXPECT_TRUE(std::is_sorted(sewn->source.begin(), sewn->source.end()));
    }
  });
}

}  // namespace
}  // namespace meshrepair
