#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include <bsp/error.h>
#include <repair/inside_rule.h>
#include <repair/repair.h>

#include "graphs.h"
#include "shapes.h"

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

// Triangles without common points: nothing tells how they belong together, so orientation is
// worthless.
TEST(InsideRule, AutomaticDoesNotTrustRandomOrientation) {
  const TriangleSoup whole = sphere(kTriangles);
  TriangleSoup torn;
  for (const auto& t : whole.triangles) {
    // Overlaps its neighbours and shares no edge with them.
    const Vec3d centre = (whole.points[t[0]] + whole.points[t[1]] + whole.points[t[2]]) / 3;
    const auto base = static_cast<std::uint32_t>(torn.points.size());
    for (const std::uint32_t c : t)
      torn.points.push_back(centre + 1.001 * (whole.points[c] - centre));
    torn.triangles.push_back({base, base + 1, base + 2});
  }
  const double truth = signed_volume(whole);
  const Outcome mixed = solve(with_some_flipped(torn, 0.5, 5), InsideRule::automatic);
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
    const CellLabels labels = label_cells(g.graph, options, report);
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
