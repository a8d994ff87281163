// SPDX-License-Identifier: MIT
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <base/error.h>
#include <repair/inside_rule.h>
#include <repair/repair.h>

#include "each_seed.h"
#include "graphs.h"
#include "shapes.h"
#include "share_of_cases.h"

namespace meshrepair {
namespace {

using namespace testing;

constexpr std::size_t kTriangles = 600;
// New points lie in the planes of the rounded triangles: some grid steps of 2^-25 on an area of 25.
constexpr double kGridError = 1e-6;

struct Outcome {
  double volume = 0;
  InsideReport report;
};

Outcome solve(const TriangleSoup& soup, InsideRule rule) {
  RepairOptions options;
  options.inside.rule = rule;
  options.holes.mode = HoleMode::extend;  // the rules have to bridge gaps by themselves
  const RepairResult result = repair(soup, options);
  expect_closed_manifold(result.surface.mesh);
  EXPECT_EQ(result.report.inside.asked, rule);
  EXPECT_FALSE(result.report.inside.reason.empty());
  return {result.report.output_volume, result.report.inside};
}

double volume_by(const TriangleSoup& soup, InsideRule rule) { return solve(soup, rule).volume; }

// Two spheres of a triangulation that does not matter; their volumes are found by the walk itself
// on the closed input.
struct SphereVolumes {
  double each = signed_volume(sphere(kTriangles / 2));
  double union_of_both = volume_by(two_overlapping_spheres(kTriangles), InsideRule::winding);
};

const SphereVolumes& sphere_volumes() {
  static const SphereVolumes volumes;
  return volumes;
}

TEST(InsideRule, OverlappingSpheres) {
  const TriangleSoup soup = two_overlapping_spheres(kTriangles);
  const double united = sphere_volumes().union_of_both;
  const double common = 2 * sphere_volumes().each - united;
  // Union of unit balls with centres 0.784 apart.
  EXPECT_NEAR(united, 6.5, 0.3);
  const Outcome automatic = solve(soup, InsideRule::automatic);
  EXPECT_EQ(automatic.report.used, InsideRule::winding);
  EXPECT_TRUE(automatic.report.exact);
  EXPECT_NEAR(automatic.volume, united, kGridError);
  EXPECT_NEAR(volume_by(soup, InsideRule::solidity), united, kGridError);
  // A parity rule: where shells overlap it says empty.
  EXPECT_NEAR(volume_by(soup, InsideRule::parity), united - common, kGridError);
}

TEST(InsideRule, OverlappingSpheresWithMissingTriangles) {
  const TriangleSoup soup = without_some(two_overlapping_spheres(kTriangles), 0.05, 1);
  const double united = sphere_volumes().union_of_both;
  EXPECT_NEAR(volume_by(soup, InsideRule::winding), united, 0.02 * united);
  const Outcome automatic = solve(soup, InsideRule::automatic);
  EXPECT_EQ(automatic.report.used, InsideRule::winding);
  EXPECT_FALSE(automatic.report.exact);
  EXPECT_GT(automatic.report.contradictions, 0u);
  EXPECT_NEAR(automatic.volume, united, 0.02 * united);
  // The flood may leak into the overlap, never beyond the solid.
  EXPECT_LT(volume_by(soup, InsideRule::solidity), 1.02 * united);
}

TEST(InsideRule, AnInvertedCoreInACavityThatDoesNotTellIsSolid) {
  const TriangleSoup outer = sphere(1000), wall = sphere(1000, 0.7), core = sphere(1000, 0.4);
  const double expected = signed_volume(outer) - signed_volume(wall) + signed_volume(core);
  for (std::uint64_t seed = 0; seed < share_of_cases(10u); ++seed) {
    SCOPED_TRACE(seed);
    TriangleSoup soup = outer;
    append(soup, with_some_flipped(wall, 0.5, seed));
    append(soup, flipped(core));
    EXPECT_NEAR(solve(soup, InsideRule::automatic).volume, expected, 1e-6);
  }
}

// Their common faces are walls that nothing tells from outer ones once triangles are flipped: the
// winding numbers contradict themselves, and solidity leaves nothing out.
TEST(InsideRule, TouchingCubesStayWholeWhateverIsFlipped) {
  TriangleSoup cubes = cube();
  append(cubes, moved(cube(), {1, 0, 0}));
  append(cubes, moved(cube(), {1, 1, 0}));
  for_each_seed(30, [&](std::uint64_t seed) {
    EXPECT_NEAR(solve(with_some_flipped(cubes, 0.5, seed), InsideRule::automatic).volume, 3, 1e-6);
  });
}

TEST(InsideRule, HollowSphere) {
  TriangleSoup soup = sphere(kTriangles / 2);
  append(soup, flipped(sphere(kTriangles / 2, 0.5)));
  const double shell = signed_volume(soup);
  const double filled = sphere_volumes().each;
  EXPECT_NEAR(volume_by(soup, InsideRule::automatic), shell, kGridError);
  EXPECT_NEAR(volume_by(soup, InsideRule::winding), shell, kGridError);
  EXPECT_NEAR(volume_by(soup, InsideRule::parity), shell, kGridError);
  EXPECT_NEAR(volume_by(soup, InsideRule::solidity), filled, kGridError);
}

TEST(InsideRule, MissingTrianglesChangeLittle) {
  const TriangleSoup whole = sphere(kTriangles);
  const double truth = signed_volume(whole);
  for (const double share : {0.02, 0.1}) {
    SCOPED_TRACE(share);
    const TriangleSoup soup = without_some(whole, share, 2);
    for (const InsideRule rule :
         {InsideRule::automatic, InsideRule::solidity, InsideRule::parity, InsideRule::winding}) {
      SCOPED_TRACE(rule_name(rule));
      EXPECT_NEAR(volume_by(soup, rule), truth, 0.02 * truth);
    }
  }
}

TEST(InsideRule, FlippedTrianglesDoNotMatterToSolidity) {
  const TriangleSoup whole = sphere(kTriangles);
  const double truth = signed_volume(whole);
  for (const double share : {0.2, 0.5, 1.0}) {
    SCOPED_TRACE(share);
    const TriangleSoup soup = with_some_flipped(whole, share, 3);
    EXPECT_NEAR(volume_by(soup, InsideRule::solidity), truth, kGridError);
    EXPECT_NEAR(volume_by(soup, InsideRule::parity), truth, kGridError);
    // Each part is oriented before the winding is looked at, and may come out inside out.
    EXPECT_NEAR(volume_by(soup, InsideRule::automatic), truth, kGridError);
  }
}

TEST(InsideRule, WindingTakesTheOrientationAsItIs) {
  const TriangleSoup whole = sphere(kTriangles);
  const double truth = signed_volume(whole);
  EXPECT_NEAR(volume_by(with_some_flipped(whole, 0.1, 4), InsideRule::winding), truth,
              0.05 * truth);
  EXPECT_THROW((void)volume_by(flipped(whole), InsideRule::winding), NoSolidError);
}

// Each of these must leave the solid as it is.
struct Damage {
  const char* name;
  TriangleSoup (*apply)(const TriangleSoup&);
};

TriangleSoup with_every_face_doubled(const TriangleSoup& soup) {
  TriangleSoup doubled = soup;
  const TriangleSoup opposite = flipped(soup);
  doubled.triangles.insert(doubled.triangles.end(), opposite.triangles.begin(),
                           opposite.triangles.end());
  return doubled;
}

const std::vector<Damage>& damages() {
  static const std::vector<Damage> all = {
      {"none", [](const TriangleSoup& s) { return s; }},
      {"all flipped", [](const TriangleSoup& s) { return flipped(s); }},
      {"20 % flipped", [](const TriangleSoup& s) { return with_some_flipped(s, 0.2, 1); }},
      {"50 % flipped", [](const TriangleSoup& s) { return with_some_flipped(s, 0.5, 2); }},
      {"doubled", [](const TriangleSoup& s) { return with_every_face_doubled(s); }}};
  return all;
}

// Balls in cavities in balls.
TriangleSoup nested_shells(int count) {
  TriangleSoup soup;
  for (int i = 0; i < count; ++i) {
    const TriangleSoup shell = sphere(kTriangles, 1 - 0.2 * i);
    append(soup, i % 2 == 0 ? shell : flipped(shell));
  }
  return soup;
}

TEST(InsideRule, NestedShellsKeepTheirCavitiesWhateverTheirOrientation) {
  for (int shells = 1; shells <= 4; ++shells) {
    const TriangleSoup soup = nested_shells(shells);
    const double truth = signed_volume(soup);
    for (const Damage& damage : damages()) {
      SCOPED_TRACE(std::to_string(shells) + " shells, " + damage.name);
      const Outcome outcome = solve(damage.apply(soup), InsideRule::automatic);
      EXPECT_EQ(outcome.report.used, InsideRule::winding) << outcome.report.reason;
      EXPECT_TRUE(outcome.report.exact);
      EXPECT_NEAR(outcome.volume, truth, kGridError) << outcome.report.reason;
    }
  }
}

TEST(InsideRule, OverlapsAreUnitedWhateverTheirOrientation) {
  const TriangleSoup soup = two_overlapping_spheres(kTriangles);
  for (const Damage& damage : damages()) {
    SCOPED_TRACE(damage.name);
    EXPECT_NEAR(volume_by(damage.apply(soup), InsideRule::automatic),
                sphere_volumes().union_of_both, kGridError);
  }
}

// A shell that crosses another or lies beside it is inside out when it faces inward.
TEST(InsideRule, PartsThatAreInsideOutAreTurned) {
  for (const Vec3d& away : {Vec3d(0.7, 0.31, 0.17), Vec3d(4, 0, 0)}) {
    const TriangleSoup one = sphere(kTriangles);
    const TriangleSoup other = moved(sphere(kTriangles), away);
    TriangleSoup both = one;
    append(both, other);
    const double truth = volume_by(both, InsideRule::winding);
    for (const bool first : {false, true}) {
      TriangleSoup soup = first ? flipped(one) : one;
      append(soup, first ? other : flipped(other));
      const Outcome outcome = solve(soup, InsideRule::automatic);
      EXPECT_NEAR(outcome.volume, truth, kGridError);
      EXPECT_EQ(outcome.report.turned_parts, 1u);
      EXPECT_NE(outcome.report.reason.find("1 part inside out and turned"), std::string::npos);
    }
  }
}

// All inward, the two shells by themselves would be a ball in a ball that is inside out. What
// crosses the outer one tells that this one alone is.
TEST(InsideRule, ACavityStaysWhenTheShellAroundItIsTurned) {
  TriangleSoup right = sphere(kTriangles);
  TriangleSoup wrong = flipped(right);
  for (TriangleSoup* soup : {&right, &wrong}) {
    append(*soup, flipped(sphere(kTriangles, 0.5)));
    append(*soup, sphere(200, 0.3, {1, 0.03, 0.02}));
  }
  EXPECT_NEAR(volume_by(wrong, InsideRule::automatic), volume_by(right, InsideRule::winding),
              kGridError);
}

// The orientation is believed where it is consistent: two balls, one in the other, are one.
TEST(InsideRule, ABallInABallIsSolid) {
  TriangleSoup soup = sphere(kTriangles);
  append(soup, sphere(kTriangles, 0.5));
  const double truth = signed_volume(sphere(kTriangles));
  EXPECT_NEAR(volume_by(soup, InsideRule::automatic), truth, kGridError);
  EXPECT_NEAR(volume_by(flipped(soup), InsideRule::automatic), truth, kGridError);
}

// Two boxes share a side, which is there both ways round, and one of the boxes may be inside out:
// the shared facets count for both.
TEST(InsideRule, TouchingPartsAreTurnedOneByOne) {
  const TriangleSoup left = box({0, 0, 0}, {1, 1, 1});
  const TriangleSoup right = box({1, 0.25, 0.25}, {2, 0.75, 0.75});
  for (const bool turn_left : {false, true}) {
    for (const bool turn_right : {false, true}) {
      TriangleSoup soup = turn_left ? flipped(left) : left;
      append(soup, turn_right ? flipped(right) : right);
      const Outcome outcome = solve(soup, InsideRule::automatic);
      EXPECT_NEAR(outcome.volume, 1.25, kGridError) << outcome.report.reason;
      EXPECT_TRUE(outcome.report.exact);
    }
  }
}

// One half of a bow tie winds the other way.
TEST(InsideRule, ASurfaceThatCrossesItselfIsSolidOnBothSides) {
  TriangleSoup soup;
  const auto add = [&](double x, double y, double z) { soup.points.emplace_back(x, y, z); };
  for (const double z : {0.0, 1.0}) {
    add(-1, -1, z);
    add(1, 0.5, z);
    add(1, -0.5, z);
    add(-1, 1, z);
  }
  for (const std::uint32_t k : {0u, 1u, 2u, 3u}) {
    const std::uint32_t n = (k + 1) % 4;
    soup.triangles.push_back({k, n, n + 4});
    soup.triangles.push_back({k, n + 4, k + 4});
  }
  // The ends cross themselves: each is two triangles around the crossing and back.
  soup.triangles.push_back({0, 2, 1});
  soup.triangles.push_back({0, 3, 2});
  soup.triangles.push_back({4, 5, 6});
  soup.triangles.push_back({4, 6, 7});
  const double truth = volume_by(soup, InsideRule::parity);
  EXPECT_GT(truth, 1);
  EXPECT_NEAR(volume_by(soup, InsideRule::automatic), truth, kGridError);
  EXPECT_NEAR(volume_by(flipped(soup), InsideRule::automatic), truth, kGridError);
}

Outcome solve_filled(const TriangleSoup& soup, InsideRule rule) {
  RepairOptions options;
  options.inside.rule = rule;
  options.inside.cavities = Cavities::fill;
  const RepairResult result = repair(soup, options);
  expect_closed_manifold(result.surface.mesh);
  return {result.report.output_volume, result.report.inside};
}

TEST(InsideRule, FillingMakesEveryVoidSolid) {
  for (const InsideRule rule :
       {InsideRule::automatic, InsideRule::solidity, InsideRule::parity, InsideRule::winding}) {
    SCOPED_TRACE(rule_name(rule));
    const Outcome outcome = solve_filled(nested_shells(4), rule);
    EXPECT_NEAR(outcome.volume, signed_volume(sphere(kTriangles)), kGridError);
    EXPECT_EQ(outcome.report.filled_voids, 2u);
    EXPECT_EQ(solve_filled(sphere(kTriangles), rule).report.filled_voids, 0u);
  }
  EXPECT_EQ(solve(nested_shells(4), InsideRule::solidity).report.filled_voids, 2u);
  EXPECT_EQ(solve(nested_shells(4), InsideRule::automatic).report.filled_voids, 0u);
}

TEST(InsideRule, OverlapsAreNoVoids) {
  for (const InsideRule rule :
       {InsideRule::automatic, InsideRule::solidity, InsideRule::parity, InsideRule::winding}) {
    SCOPED_TRACE(rule_name(rule));
    const Outcome outcome = solve_filled(two_overlapping_spheres(kTriangles), rule);
    EXPECT_NEAR(outcome.volume, sphere_volumes().union_of_both, kGridError);
    EXPECT_EQ(outcome.report.filled_voids, 0u);
  }
}

// Turned at random, triangles that share no points say nothing at all.
TriangleSoup without_common_points(const TriangleSoup& soup) {
  TriangleSoup loose;
  for (const auto& t : soup.triangles) {
    const Vec3d centre = (soup.points[t[0]] + soup.points[t[1]] + soup.points[t[2]]) / 3;
    const auto base = static_cast<std::uint32_t>(loose.points.size());
    // Overlaps its neighbours and shares no edge with them.
    for (const std::uint32_t c : t) {
      loose.points.push_back(centre + 1.001 * (soup.points[c] - centre));
    }
    loose.triangles.push_back({base, base + 1, base + 2});
  }
  return loose;
}

TEST(InsideRule, AutomaticDoesNotTrustRandomOrientation) {
  const TriangleSoup whole = sphere(kTriangles);
  const double truth = signed_volume(whole);
  const Outcome mixed =
      solve(with_some_flipped(without_common_points(whole), 0.5, 5), InsideRule::automatic);
  EXPECT_EQ(mixed.report.used, InsideRule::solidity);
  EXPECT_NEAR(mixed.volume, truth, 0.02 * truth);
}

TEST(InsideRule, LabelsAgreeWithTheirReport) {
  for (const InsideRule rule :
       {InsideRule::automatic, InsideRule::solidity, InsideRule::parity, InsideRule::winding}) {
    SCOPED_TRACE(rule_name(rule));
    const Graph g = graph_of(without_some(two_overlapping_spheres(400), 0.05, 6));
    InsideOptions options;
    options.rule = rule;
    InsideReport report;
    const CellLabels labels = label_cells(g.graph, g.orientation, options, report);
    ASSERT_EQ(labels.solid.size(), g.graph.cells());
    ASSERT_EQ(labels.confidence.size(), g.graph.cells());
    std::size_t solid = 0;
    for (CellId c(0u); c.index() < g.graph.cells(); ++c.value) {
      solid += labels.solid[c.index()] != 0;
      EXPECT_GE(labels.confidence[c.index()], 0);
      EXPECT_LE(labels.confidence[c.index()], 1);
      EXPECT_FALSE(g.graph.unbounded(c) && labels.solid[c.index()] != 0);
    }
    EXPECT_EQ(report.solid_cells, solid);
    EXPECT_NE(report.used, InsideRule::automatic);
  }
}

TEST(InsideRule, NamesAreDistinct) {
  EXPECT_EQ(rule_name(InsideRule::automatic), "auto");
  EXPECT_EQ(rule_name(InsideRule::solidity), "solidity");
  EXPECT_EQ(rule_name(InsideRule::parity), "parity");
  EXPECT_EQ(rule_name(InsideRule::winding), "winding");
}

}  // namespace
}  // namespace meshrepair
