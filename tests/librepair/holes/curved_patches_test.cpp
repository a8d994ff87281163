// SPDX-License-Identifier: MIT
// Patches that go on as the surface around the hole does.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <set>
#include <utility>

#include <gtest/gtest.h>

#include <repair/hole_patches.h>
#include <repair/repair.h>

#include "shapes.h"
#include "share_of_cases.h"
#include "trees.h"

namespace meshrepair {
namespace {

using namespace testing;

using Inside = std::function<bool(const Vec3d&)>;

// Without the triangles whose middle is inside.
TriangleSoup pierced(const TriangleSoup& soup, const Inside& inside) {
  TriangleSoup kept;
  kept.points = soup.points;
  for (const auto& t : soup.triangles) {
    const Vec3d middle = (soup.points[t[0]] + soup.points[t[1]] + soup.points[t[2]]) / 3;
    if (!inside(middle)) kept.triangles.push_back(t);
  }
  return kept;
}

Inside ball(const Vec3d& centre, double radius) {
  return [=](const Vec3d& p) { return (p - centre).norm() < radius; };
}

RepairResult closed_by(const TriangleSoup& soup, HoleMode mode) {
  RepairOptions options;
  options.holes.mode = mode;
  RepairResult result = repair(soup, options);
  EXPECT_TRUE(result.report.output.closed() && result.report.output.manifold());
  EXPECT_TRUE(result.report.certify.passed());
  return result;
}

double volume_error(const TriangleSoup& whole, const TriangleSoup& open, HoleMode mode) {
  const double volume = signed_volume(whole);
  return std::abs(closed_by(open, mode).report.output_volume - volume) / volume;
}

TEST(CurvedPatches, OfASphereAreNearlyRound) {
  const TriangleSoup whole = sphere(6000);
  const TriangleSoup open = pierced(whole, ball({0.6, -0.64, 0.48}, 0.5));
  EXPECT_GT(volume_error(whole, open, HoleMode::flat), 5e-3);
  EXPECT_LT(volume_error(whole, open, HoleMode::patch), 5e-4);
  const RepairResult result = closed_by(open, HoleMode::patch);
  EXPECT_EQ(result.report.holes.curved, 1u);
  for (const Vec3d& p : result.surface.mesh.points) EXPECT_NEAR(p.norm(), 1, 2e-2);
}

// 15 % of the sphere is missing.
const Inside kLargeCap = ball({0.6, -0.64, 0.48}, 0.775);

TEST(CurvedPatches, OfALargeCapOfASphereAreNearlyRound) {
  const TriangleSoup whole = sphere(5000);
  const TriangleSoup open = pierced(whole, kLargeCap);
  EXPECT_GT(volume_error(whole, open, HoleMode::flat), 3e-2);
  EXPECT_LT(volume_error(whole, open, HoleMode::curved), 2e-3);
}

// The patch runs round its rim in a direction of its own.
TEST(CurvedPatches, AreTheSameWhicheverWayTheSurfaceRuns) {
  TriangleSoup open = pierced(sphere(5000), kLargeCap);
  for (int turn = 0; turn < 2; ++turn) {
    CleanSoup soup = cleaned(open);
    HoleOptions options;
    options.mode = HoleMode::curved;
    HoleReport report;
    patch_holes(soup, options, report);
    EXPECT_EQ(report.curved, 1u);
    for (PointId p(0u); p < soup.points.end_id(); ++p.value) {
      EXPECT_NEAR(soup.points[p].norm(), 1, 5e-3);
    }
    for (auto& t : open.triangles) std::swap(t[1], t[2]);
  }
}

TEST(CurvedPatches, OfNoisySpheresDoNotBulge) {
  for (const double noise : {0.005, 0.015}) {  // 10 % and 30 % of an edge
    for (std::uint64_t seed = 1; seed <= share_of_cases(4u); ++seed) {
      SCOPED_TRACE(seed);
      Random random(seed);
      TriangleSoup whole = sphere(5000);
      for (Vec3d& p : whole.points) {
        p += noise * Vec3d(random.real(-1, 1), random.real(-1, 1), random.real(-1, 1));
      }
      const TriangleSoup open = pierced(whole, kLargeCap);
      EXPECT_LT(volume_error(whole, open, HoleMode::curved), 1.5e-2);
      for (const Vec3d& p : closed_by(open, HoleMode::curved).surface.mesh.points) {
        EXPECT_LT(p.norm(), 1.02 + noise);
      }
    }
  }
}

// Open at both ends, of radius 1, from z = 0 on in rows of this height.
TriangleSoup cylinder(std::uint32_t around, std::uint32_t along, double row) {
  TriangleSoup soup;
  for (std::uint32_t z = 0; z <= along; ++z) {
    for (std::uint32_t i = 0; i < around; ++i) {
      const double a = 2 * std::numbers::pi * i / around;
      soup.points.emplace_back(std::cos(a), std::sin(a), row * z);
    }
  }
  for (std::uint32_t p = 0; p < along * around; ++p) {
    const std::uint32_t next = p % around + 1 == around ? p + 1 - around : p + 1;
    soup.triangles.push_back({p, next, next + around});
    soup.triangles.push_back({p, next + around, p + around});
  }
  return soup;
}

TEST(CurvedPatches, OfACylinderStayOnIt) {
  const TriangleSoup whole = cylinder(120, 60, 0.05);
  const TriangleSoup open = pierced(whole, ball({1, 0, 1.5}, 0.7));
  const RepairResult result = closed_by(open, HoleMode::patch);
  EXPECT_EQ(result.report.holes.curved, 1u);
  for (const Vec3d& p : result.surface.mesh.points) {
    EXPECT_NEAR(std::hypot(p.x(), p.y()), 1, 1e-2);
  }
}

TEST(CurvedPatches, GrowCoarserInwards) {
  const TriangleSoup whole = sphere(20000);
  const TriangleSoup open = pierced(whole, kLargeCap);
  const RepairResult result = closed_by(open, HoleMode::curved);
  const std::size_t missing = whole.triangles.size() - open.triangles.size();
  EXPECT_LT(result.report.holes.triangles, 0.5 * static_cast<double>(missing));
  EXPECT_LT(std::abs(result.report.output_volume / signed_volume(whole) - 1), 2e-3);
}

TEST(CurvedPatches, OfATorusFollowBothCurvatures) {
  const TriangleSoup whole = torus(120, 60);
  for (const Vec3d& centre : {Vec3d(2.7, 0, 0), Vec3d(1.3, 0, 0), Vec3d(2, 0, 0.7)}) {
    const TriangleSoup open = pierced(whole, ball(centre, 0.35));
    EXPECT_LT(volume_error(whole, open, HoleMode::curved),
              0.3 * volume_error(whole, open, HoleMode::flat));
  }
}

// A hole on top is closed flat, unless it is asked for more.
TEST(CurvedPatches, StayWithinTheBoundingBox) {
  const TriangleSoup whole = sphere(6000);
  const TriangleSoup open = pierced(whole, ball({0, 0.28, 0.96}, 0.45));
  double top = 0;
  for (const IndexTriangle& t : open.triangles) {
    for (const std::uint32_t p : t) top = std::max(top, open.points[p].z());
  }
  for (const Vec3d& p : closed_by(open, HoleMode::patch).surface.mesh.points) {
    EXPECT_LE(p.z(), top + 0.01);
  }
  EXPECT_LT(volume_error(whole, open, HoleMode::curved), 5e-4);
}

// As where an arm is cut off between triangles.
TEST(CurvedPatches, ARaggedCutIsFlat) {
  constexpr std::uint32_t kAround = 30;
  TriangleSoup arm = cylinder(kAround, 40, 0.1);
  const auto floor = static_cast<std::uint32_t>(arm.points.size());
  arm.points.emplace_back(0, 0, 0);
  for (std::uint32_t p = 0; p < kAround; ++p) {
    arm.triangles.push_back({floor, (p + 1) % kAround, p});
  }
  const TriangleSoup open = pierced(
      arm, [](const Vec3d& p) { return p.z() > 3 + 0.3 * p.x() + 0.05 * std::sin(20 * p.y()); });
  for (const Vec3d& p : closed_by(open, HoleMode::patch).surface.mesh.points) {
    EXPECT_LE(p.z(), 3 + 0.3 * p.x() + 0.2);
  }
}

// What is missing of a prism or a box is a face, and faces are flat.
TEST(CurvedPatches, AFaceStaysFlat) {
  TriangleSoup open;
  for (std::uint32_t i = 0; i < 60; ++i) {
    const double a = 2 * std::numbers::pi * i / 60;
    open.points.emplace_back(std::cos(a), std::sin(a), 0);
    open.points.emplace_back(std::cos(a), std::sin(a), 2);
  }
  for (std::uint32_t i = 0; i < 60; ++i) {
    const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % 60);
    open.triangles.push_back({a, b, b + 1});
    open.triangles.push_back({a, b + 1, a + 1});
    if (i > 0 && i + 1 < 60) open.triangles.push_back({0, b, a});
  }
  const RepairResult result = closed_by(open, HoleMode::patch);
  EXPECT_EQ(result.report.holes.closed, 1u);
  EXPECT_EQ(result.report.holes.curved, 0u);
  EXPECT_EQ(result.surface.mesh.points.size(), open.points.size());
}

TEST(CurvedPatches, AHoleInAPlaneGetsNoPoints) {
  TriangleSoup open;
  constexpr std::uint32_t kSide = 20;
  for (std::uint32_t y = 0; y <= kSide; ++y) {
    for (std::uint32_t x = 0; x <= kSide; ++x) open.points.emplace_back(x, y, 0);
  }
  for (std::uint32_t y = 0; y < kSide; ++y) {
    for (std::uint32_t x = 0; x < kSide; ++x) {
      const std::uint32_t a = y * (kSide + 1) + x, b = a + kSide + 1;
      open.triangles.push_back({a, a + 1, b + 1});
      open.triangles.push_back({a, b + 1, b});
    }
  }
  CleanSoup soup = cleaned(pierced(open, ball({10, 10, 0}, 5)));
  const std::size_t points = soup.points.size();
  HoleReport report;
  patch_holes(soup, {}, report);
  EXPECT_GE(report.closed, 1u);
  EXPECT_EQ(report.curved, 0u);
  EXPECT_EQ(soup.points.size(), points);
}

// Each point has one place on the grid, and is written where it is.
TEST(CurvedPatches, NewPointsAreOnTheGridAndDifferent) {
  const TriangleSoup open = pierced(sphere(6000), ball({0, 0.8, 0.6}, 0.6));
  CleanSoup soup = cleaned(open);
  const std::size_t given = soup.points.size();
  HoleReport report;
  patch_holes(soup, {}, report);
  EXPECT_EQ(report.curved, 1u);
  ASSERT_GT(soup.points.size(), given);
  std::set<GridPoint> places;
  for (PointId p(0u); p < soup.points.end_id(); ++p.value) {
    EXPECT_TRUE(places.insert(soup.grid_points[p]).second);
    EXPECT_EQ(soup.grid.to_grid(soup.points[p]), soup.grid_points[p]);
  }
}

// Whatever the hole looks like: a closed solid, and the same whatever the number of threads.
TEST(CurvedPatches, RandomHolesAreClosed) {
  const TriangleSoup whole = sphere(3000);
  for (std::uint64_t seed = 1; seed <= share_of_cases(12u); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    TriangleSoup open = whole;
    for (int hole = 0; hole < 6; ++hole) {
      const Vec3d centre(random.real(-1, 1), random.real(-1, 1), random.real(-1, 1));
      open = pierced(open, ball(centre.normalized(), random.real(0.1, 0.5)));
    }
    for (Vec3d& p : open.points) p *= random.real(0.97, 1.03);
    const RepairResult result = closed_by(open, HoleMode::curved);
    EXPECT_GT(result.report.output_volume, 0.85 * signed_volume(whole));
    EXPECT_LT(result.report.output_volume, 1.1 * signed_volume(whole));
  }
}

}  // namespace
}  // namespace meshrepair
