// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <repair/hole_patches.h>
#include <repair/orient_parts.h>
#include <repair/repair.h>

#include "degenerate_soups.h"
#include "each_seed.h"
#include "random_geometry.h"
#include "shapes.h"
#include "share_of_cases.h"
#include "trees.h"

namespace meshrepair {
namespace {

using namespace testing;

TriangleSoup without(TriangleSoup soup, const std::set<std::size_t>& gone) {
  TriangleSoup kept;
  kept.points = soup.points;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    if (!gone.contains(t)) kept.triangles.push_back(soup.triangles[t]);
  }
  return kept;
}

struct Patched {
  CleanSoup soup;
  HoleReport report;
  Topology topology;
};

Patched patched(const TriangleSoup& soup, const HoleOptions& options = {}) {
  Patched result;
  result.soup = cleaned(soup);
  const std::size_t given = result.soup.triangles.size();
  patch_holes(result.soup, options, result.report);
  EXPECT_EQ(result.report.triangles, result.soup.triangles.size() - given);
  for (TriangleId t(0u); t < result.soup.triangles.end_id(); ++t.value) {
    EXPECT_EQ(result.soup.triangles[t].source == Triangle::kNoSource, t.index() >= given);
  }
  result.topology = examine_topology(index_triangles(result.soup), result.soup.points.size());
  return result;
}

double repaired_volume(const TriangleSoup& soup) { return repair(soup).report.output_volume; }

TEST(PatchHoles, AClosedSoupIsNotChanged) {
  for (const TriangleSoup& soup : {cube(), torus(12, 9), random_cubes(5, 1)}) {
    EXPECT_EQ(patched(soup).report.loops, 0u);
    EXPECT_EQ(patched(soup).report.triangles, 0u);
  }
}

TEST(PatchHoles, AMissingTriangleComesBack) {
  for (std::size_t gone = 0; gone < 12; ++gone) {
    SCOPED_TRACE(gone);
    const Patched p = patched(without(cube(), {gone}));
    EXPECT_EQ(p.report.closed, 1u);
    EXPECT_EQ(p.report.triangles, 1u);
    EXPECT_DOUBLE_EQ(p.report.area, 0.5);
    EXPECT_TRUE(p.topology.closed() && p.topology.manifold() && p.topology.oriented());
    EXPECT_EQ(repaired_volume(without(cube(), {gone})), 1);
  }
}

TEST(PatchHoles, AMissingFaceIsClosedInItsPlane) {
  const Patched p = patched(without(cube(), {4, 5}));
  EXPECT_EQ(p.report.longest_loop, 4u);
  EXPECT_DOUBLE_EQ(p.report.area, 1);
  EXPECT_TRUE(p.topology.closed() && p.topology.manifold() && p.topology.oriented());
}

TEST(PatchHoles, ALargeLoopThatIsNotConvexGetsNoMoreThanItsArea) {
  // A star-shaped prism without its lid: all triangulations inside the outline have one area.
  constexpr std::uint32_t kPoints = 40;
  TriangleSoup prism;
  for (std::uint32_t i = 0; i < kPoints; ++i) {
    const double a = 2 * std::numbers::pi * i / kPoints;
    const double r = i % 2 == 0 ? 1024 : 512;
    for (const double z : {0.0, 300.0}) {
      prism.points.emplace_back(std::round(r * std::cos(a)), std::round(r * std::sin(a)), z);
    }
  }
  prism.points.emplace_back(0, 0, 0);
  double floor = 0;
  for (std::uint32_t i = 0; i < kPoints; ++i) {
    const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % kPoints);
    prism.triangles.push_back({a, b, b + 1});
    prism.triangles.push_back({a, b + 1, a + 1});
    prism.triangles.push_back({2 * kPoints, b, a});
    floor += 0.5 * prism.points[a].cross(prism.points[b]).z();
  }
  for (const std::size_t most_edges : {200u, 12u}) {
    SCOPED_TRACE(most_edges);
    HoleOptions options;
    options.most_edges = most_edges;
    const Patched p = patched(prism, options);
    EXPECT_TRUE(p.topology.closed() && p.topology.manifold() && p.topology.oriented());
    EXPECT_EQ(p.report.triangles, kPoints - 2);
    // Cut along chords first, some triangles may lie outside the outline.
    EXPECT_NEAR(p.report.area, floor, most_edges == 200 ? 1e-9 * floor : 0.5 * floor);
  }
  EXPECT_NEAR(repaired_volume(prism), 300 * floor, 1e-9 * floor);
}

TEST(PatchHoles, HolesOfASphereAreClosedSmoothly) {
  const TriangleSoup whole = sphere(5000);
  for (std::uint64_t seed = 0; seed < share_of_cases(10u); ++seed) {
    SCOPED_TRACE(seed);
    const TriangleSoup broken = without_some(whole, 0.05, seed);
    const Patched p = patched(broken);
    EXPECT_EQ(p.report.closed, p.report.loops);
    EXPECT_EQ(p.report.stray_edges, 0u);
    EXPECT_TRUE(p.topology.closed());
    EXPECT_NEAR(repaired_volume(broken), signed_volume(whole), 1e-3 * signed_volume(whole));
  }
}

TEST(PatchHoles, OrientationPlaysNoPart) {
  const TriangleSoup broken = without_some(torus(40, 20), 0.1, 1);
  const Patched straight = patched(broken);
  for_each_seed(10, [&](std::uint64_t seed) {
    const Patched turned = patched(with_some_flipped(broken, 0.5, seed));
    ASSERT_EQ(turned.soup.triangles.size(), straight.soup.triangles.size());
    for (TriangleId t(0u); t < straight.soup.triangles.end_id(); ++t.value) {
      auto a = straight.soup.triangles[t].corners, b = turned.soup.triangles[t].corners;
      std::sort(a.begin(), a.end());
      std::sort(b.begin(), b.end());
      EXPECT_EQ(a, b);
    }
  });
}

TEST(PatchHoles, HolesThatTouchInAPointAreTwo) {
  // Two triangles of a sphere's pole that share nothing else.
  const TriangleSoup whole = sphere(200);
  std::vector<std::size_t> at_pole;
  for (std::size_t t = 0; t < whole.triangles.size(); ++t) {
    const auto& c = whole.triangles[t];
    if (std::find(c.begin(), c.end(), 0u) != c.end()) at_pole.push_back(t);
  }
  ASSERT_GE(at_pole.size(), 6u);
  const Patched p = patched(without(whole, {at_pole[0], at_pole[3]}));
  EXPECT_EQ(p.report.closed, 2u);
  EXPECT_EQ(p.report.triangles, 2u);
  EXPECT_TRUE(p.topology.closed() && p.topology.manifold() && p.topology.oriented());
}

TEST(PatchHoles, ALoopIsFoundWhereThreeTrianglesMeet) {
  // Two cubes that share an edge, one of them without a triangle at that edge.
  TriangleSoup cubes = cube();
  append(cubes, moved(cube(), {1, 1, 0}));
  for (std::size_t gone = 12; gone < 24; ++gone) {
    SCOPED_TRACE(gone);
    const Patched p = patched(without(cubes, {gone}));
    EXPECT_EQ(p.report.closed, 1u);
    EXPECT_EQ(p.report.triangles, 1u);
    EXPECT_TRUE(p.topology.closed());
  }
}

TEST(PatchHoles, AWallBetweenTwoSolidsIsNoHole) {
  TriangleSoup cubes = cube();
  append(cubes, moved(cube(), {1, 0, 0}));
  EXPECT_EQ(patched(cubes).report.loops, 0u);
  EXPECT_EQ(repaired_volume(cubes), 2);
}

TEST(PatchHoles, AnOpenSheetIsLeftOpen) {
  TriangleSoup sheet;
  sheet.points = {{0, 0, 0}, {4, 0, 1}, {4, 4, 0}, {0, 4, 1}, {2, 2, 3}};
  sheet.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}};
  const Patched p = patched(sheet);
  EXPECT_EQ(p.report.loops, 1u);
  EXPECT_EQ(p.report.too_large, 1u);
  EXPECT_EQ(p.report.triangles, 0u);
}

TEST(PatchHoles, LargestShareSaysWhichHolesAreClosed) {
  // The lid that is missing is a fifth of the area that is there.
  HoleOptions options;
  options.largest_share = options.largest_flat_share = 0.21;
  EXPECT_EQ(patched(without(cube(), {4, 5}), options).report.closed, 1u);
  options.largest_share = options.largest_flat_share = 0.19;
  EXPECT_EQ(patched(without(cube(), {4, 5}), options).report.too_large, 1u);
  options.largest_share = options.largest_flat_share = -1;
  EXPECT_THROW((void)patched(cube(), options), UsageError);
}

TEST(PatchHoles, ATriangleThatJutsIntoAHoleIsNotThereTwice) {
  for_each_seed(30, [&](std::uint64_t seed) {
    const Patched p = patched(without_some(sphere(300), 0.4, seed));
    std::set<std::array<PointId, 3>> seen;
    for (const Triangle& t : p.soup.triangles) {
      auto key = t.corners;
      std::sort(key.begin(), key.end());
      EXPECT_TRUE(seen.insert(key).second);
    }
  });
}

TEST(PatchHoles, DegenerateSoupsKeepTheirInvariants) {
  for (const SoupFamily& family : degenerate_families()) {
    for_each_seed(20, [&](std::uint64_t seed) {
      SCOPED_TRACE(std::string(family.name) + " " + std::to_string(seed));
      HoleOptions options;
      options.largest_share = options.largest_flat_share = 100;
      const Patched p = patched(family.make(seed), options);
      for (const Triangle& t : p.soup.triangles) {
        for (const PointId c : t.corners) {
          EXPECT_EQ(side(p.soup.grid_points[c], p.soup.planes[t.plane]), 0);
        }
      }
    });
  }
}

TEST(PatchHoles, ModeNoneClosesNothing) {
  RepairOptions options;
  options.holes.mode = HoleMode::none;
  TriangleSoup soup = without(cube(), {3});
  RepairReport report;
  EXPECT_THROW((void)repair(soup, options, report), NoSolidError);
  append(soup, moved(sphere(300), {9, 0, 0}));
  EXPECT_NEAR(repair(soup, options).report.output_volume, signed_volume(sphere(300)), 1e-6);
  options.holes.mode = HoleMode::extend;
  EXPECT_NEAR(repair(soup, options).report.output_volume, 1 + signed_volume(sphere(300)), 1e-6);
}

// Without the triangles of which all corners satisfy the condition.
template <class Condition>
TriangleSoup without_where(const TriangleSoup& soup, Condition condition) {
  std::set<std::size_t> gone;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    const auto& c = soup.triangles[t];
    if (std::all_of(c.begin(), c.end(),
                    [&](std::uint32_t p) { return condition(soup.points[p]); })) {
      gone.insert(t);
    }
  }
  return without(soup, gone);
}

TEST(PatchHoles, AMissingRingIsClosedByARing) {
  const TriangleSoup whole = sphere(5000);
  const TriangleSoup broken =
      without_where(whole, [](const Vec3d& p) { return std::abs(p.z()) < 0.1; });
  ASSERT_LT(broken.triangles.size(), whole.triangles.size());
  const Patched p = patched(broken);
  EXPECT_EQ(p.report.rings, 1u);
  EXPECT_EQ(p.report.closed, 2u);
  EXPECT_TRUE(p.topology.closed() && p.topology.manifold() && p.topology.oriented());
  EXPECT_EQ(p.topology.parts, 1u);
  EXPECT_NEAR(repaired_volume(broken), signed_volume(whole), 2e-3 * signed_volume(whole));
}

TEST(PatchHoles, TwoHalvesOfABoxAreJoined) {
  const auto high = [](const Vec3d& p) { return p.x() == 1; };
  const auto low = [](const Vec3d& p) { return p.x() == 1.25; };
  TriangleSoup halves = without_where(box({0, 0, 0}, {1, 1, 1}), high);
  append(halves, without_where(box({1.25, 0, 0}, {2, 1, 1}), low));
  ASSERT_EQ(halves.triangles.size(), 20u);
  const Patched p = patched(halves);
  EXPECT_EQ(p.report.rings, 1u);
  EXPECT_DOUBLE_EQ(p.report.area, 1);
  EXPECT_TRUE(p.topology.closed() && p.topology.manifold() && p.topology.oriented());
  EXPECT_EQ(repaired_volume(halves), 2);
}

TEST(PatchHoles, ABowlOfTwoSheetsGetsARim) {
  const auto upper = [](const Vec3d& p) { return p.z() > -0.01; };
  TriangleSoup bowl = without_where(sphere(3000), upper);
  append(bowl, flipped(without_where(sphere(3000, 0.8), upper)));
  const Patched p = patched(bowl);
  EXPECT_EQ(p.report.rings, 1u);
  EXPECT_TRUE(p.topology.closed() && p.topology.manifold() && p.topology.oriented());
  const double half_shell = 0.5 * signed_volume(sphere(3000)) * (1 - 0.8 * 0.8 * 0.8);
  EXPECT_NEAR(repaired_volume(bowl), half_shell, 0.05 * half_shell);
}

// A dish in two pieces, with a gap between them: the wide one is closed as it is one with the
// other.
TEST(PatchHoles, ADishOfTwoPiecesIsClosedAtItsWideRim) {
  const auto ring = [](double from, double to, double radius) {
    return without_where(sphere(6000, radius), [=](const Vec3d& p) {
      const double across = std::hypot(p.x(), p.y()) / radius;
      return p.z() > 0 || across < from || across > to;
    });
  };
  TriangleSoup dish = ring(0, 0.5, 1);
  append(dish, ring(0.65, 0.85, 1));
  const Patched p = patched(dish);
  EXPECT_EQ(p.report.rings, 1u);
  EXPECT_EQ(p.report.closed, 3u);
  EXPECT_TRUE(p.topology.closed() && p.topology.oriented());
}

// A height field on a flat rim.
TEST(PatchHoles, AHillIsClosedBelow) {
  constexpr int kSteps = 20;
  TriangleSoup hill;
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; j <= kSteps; ++j) {
      const double x = 2.0 * i / kSteps - 1, y = 2.0 * j / kSteps - 1;
      hill.points.emplace_back(x, y, 0.5 * (1 - x * x) * (1 - y * y));
    }
  }
  const auto at = [](int i, int j) { return static_cast<std::uint32_t>(i * (kSteps + 1) + j); };
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      hill.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      hill.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  EXPECT_NEAR(repaired_volume(hill), 0.5 * 16 / 9, 0.01);
}

// The rim is no flat one: the planes of the faces that are there close it better than a patch.
TEST(PatchHoles, AFlatBoxWithoutTwoFacesThatMeetIsWholeAgain) {
  TriangleSoup soup = box({0, 0, 0}, {2, 1, 0.2});
  soup = without_where(soup, [](const Vec3d& p) { return p.z() == 0.2; });
  soup = without_where(soup, [](const Vec3d& p) { return p.x() == 2; });
  ASSERT_EQ(soup.triangles.size(), 8u);
  EXPECT_DOUBLE_EQ(repaired_volume(soup), 0.4);
}

// Two sheets that overlap by a narrow seam, with the ends in common: the patch lies on them.
TEST(PatchHoles, ASeamThatOverlapsIsClosed) {
  TriangleSoup soup = without(box({0, 0, 0}, {4, 4, 4}), {});
  const auto corner = [&](double x, double y, double z) {
    const auto found = std::find(soup.points.begin(), soup.points.end(), Vec3d(x, y, z));
    return static_cast<std::uint32_t>(found - soup.points.begin());
  };
  soup = without_where(soup, [](const Vec3d& p) { return p.z() == 4; });
  const std::uint32_t a = corner(0, 0, 4), b = corner(4, 0, 4), c = corner(4, 4, 4),
                      d = corner(0, 4, 4);
  soup.points.emplace_back(2.0, 2.0, 4.0);
  soup.points.emplace_back(2.0, -0.1, 4.01);
  const auto middle = static_cast<std::uint32_t>(soup.points.size() - 2);
  const std::uint32_t over = middle + 1;
  // The edge from a to b is that of the wall, above it the lid comes over it.
  for (const auto& t : std::vector<std::array<std::uint32_t, 3>>{
           {a, over, middle}, {over, b, middle}, {b, c, middle}, {c, d, middle}, {d, a, middle}}) {
    soup.triangles.push_back(t);
  }
  const Patched p = patched(soup);
  EXPECT_EQ(p.report.loops, 1u);
  EXPECT_EQ(p.report.closed, 1u);
  EXPECT_TRUE(p.topology.closed() && p.topology.manifold() && p.topology.oriented());
}

TEST(PatchHoles, AShortTubeIsClosedByTwoLids) {
  // A ring between its rims would be the tube itself.
  TriangleSoup tube = box({0, 0, 0}, {4, 4, 0.5});
  tube = without_where(tube, [](const Vec3d& p) { return p.z() == 0; });
  tube = without_where(tube, [](const Vec3d& p) { return p.z() == 0.5; });
  ASSERT_EQ(tube.triangles.size(), 8u);
  const Patched p = patched(tube);
  EXPECT_EQ(p.report.rings, 0u);
  EXPECT_EQ(p.report.closed, 2u);
  EXPECT_DOUBLE_EQ(p.report.area, 32);
  EXPECT_TRUE(p.topology.closed() && p.topology.manifold() && p.topology.oriented());
}

// A fan in the plane z = 0 whose rim is that of the upper half of a sphere.
TriangleSoup sphere_with_wall() {
  TriangleSoup soup = sphere(1444);
  std::vector<std::pair<double, std::uint32_t>> equator;
  for (std::uint32_t p = 0; p < soup.points.size(); ++p) {
    const Vec3d& at = soup.points[p];
    if (std::abs(at.z()) < 1e-9) equator.emplace_back(std::atan2(at.y(), at.x()), p);
  }
  std::sort(equator.begin(), equator.end());
  soup.points.emplace_back(0, 0, 0);
  const auto middle = static_cast<std::uint32_t>(soup.points.size() - 1);
  for (std::size_t i = 0; i < equator.size(); ++i) {
    soup.triangles.push_back({middle, equator[i].second, equator[(i + 1) % equator.size()].second});
  }
  return soup;
}

TEST(PatchHoles, TheRimOfAWallIsNoHole) {
  const TriangleSoup soup = sphere_with_wall();
  ASSERT_GT(soup.triangles.size(), sphere(1444).triangles.size() + 10);
  EXPECT_EQ(patched(soup).report.loops, 0u);
  for_each_seed(5, [&](std::uint64_t seed) {
    EXPECT_NEAR(repaired_volume(with_some_flipped(soup, 0.5, seed)), signed_volume(sphere(1444)),
                1e-6);
  });
}

TEST(PatchHoles, AFinIsNotDoubled) {
  // Along the edge of two triangles of the cube's top, with a border of two edges.
  TriangleSoup soup = cube();
  soup.points.emplace_back(0.5, 0.5, 1.5);
  const auto& t = soup.triangles[10];
  soup.triangles.push_back({t[0], t[2], 8});
  HoleOptions options;
  options.largest_share = options.largest_flat_share = 10;
  const Patched p = patched(soup, options);
  EXPECT_EQ(p.report.loops, 1u);
  EXPECT_EQ(p.report.triangles, 0u);
  EXPECT_EQ(repaired_volume(soup), 1);
}

TEST(PatchHoles, MissingTrianglesThatFaceEachOtherAreNoGap) {
  TriangleSoup shell = without(sphere(1000), {400});
  append(shell, flipped(without(sphere(1000, 0.97), {400})));
  EXPECT_EQ(patched(shell).report.rings, 0u);
  EXPECT_EQ(patched(shell).report.closed, 2u);
  TriangleSoup twice = without(sphere(1000), {400});
  append(twice, without(sphere(1000, 0.97), {400}));
  EXPECT_NEAR(repaired_volume(twice), signed_volume(sphere(1000)), 1e-6);
}

// On a side of the triangle a spike, so flat that its front, which is missing, lies on its back.
void put_open_spike(TriangleSoup& soup, std::size_t triangle) {
  const auto [p, q, r] = soup.triangles[triangle];
  const Vec3d middle = 0.5 * (soup.points[p] + soup.points[q]);
  const auto m = static_cast<std::uint32_t>(soup.points.size());
  soup.points.push_back(middle + 0.05 * (soup.points[r] - middle));
  const std::uint32_t tip = m + 1;
  soup.points.emplace_back(1.3 * middle);
  soup.triangles[triangle] = {q, r, m};
  soup.triangles.insert(soup.triangles.end(), {{r, p, m}, {q, m, tip}, {m, p, tip}});
}

TEST(PatchHoles, SmallFlatHolesFarFromEachOtherGetNoTunnel) {
  TriangleSoup soup = sphere(2000);
  const double volume = signed_volume(soup);
  put_open_spike(soup, 10);
  put_open_spike(soup, 1200);
  const Patched p = patched(soup);
  EXPECT_EQ(p.report.loops, 2u);
  EXPECT_EQ(p.report.rings, 0u);
  const RepairResult result = repair(soup);
  EXPECT_TRUE(result.report.certify.passed());
  EXPECT_NEAR(result.report.output_volume, volume, 1e-3 * volume);
}

TEST(PatchHoles, AConeWithoutItsBaseIsClosed) {
  TriangleSoup open = cone(100);
  open.triangles.resize(100);
  const double whole = signed_volume(cone(100));
  EXPECT_NEAR(repaired_volume(open), whole, 1e-6 * whole);
}

}  // namespace
}  // namespace meshrepair
