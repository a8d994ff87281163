// SPDX-License-Identifier: MIT
// What holds for every soup with floating predicates, whatever their tolerance.
#include <array>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include <base/error.h>
#include <base/parallel.h>
#include <bsp/tree_io.h>
#include <check/self_intersections.h>
#include <repair/repair.h>

#include "complexes.h"
#include "degenerate_soups.h"
#include "share_of_cases.h"

namespace meshrepair {
namespace {

using namespace testing;

constexpr std::array kEpsilons = {0.0, 1e-15, kDefaultEpsilon, 1e-4, 1e-2};

RepairOptions in_floating_point(double epsilon) {
  RepairOptions options;
  options.predicates = Predicates::floating;
  options.epsilon = epsilon;
  return options;
}

// Nothing where the soup encloses nothing.
std::optional<RepairResult> repaired(const TriangleSoup& soup, const RepairOptions& options) {
  try {
    return repair(soup, options);
  } catch (const NoSolidError&) {
    return std::nullopt;
  }
}

void expect_true_report(const RepairResult& result, double epsilon) {
  expect_closed_manifold(result.surface.mesh);
  for (const Vec3d& p : result.surface.mesh.points) ASSERT_TRUE(p.allFinite());
  const RepairReport& report = result.report;
  EXPECT_EQ(report.predicates, Predicates::floating);
  EXPECT_EQ(report.epsilon, epsilon);
  EXPECT_TRUE(report.output.closed() && report.output.manifold() && report.output.oriented());
  EXPECT_TRUE(report.certify.done);
  EXPECT_EQ(report.certify.rounds, 0u);
  const SelfIntersections found = self_intersections(result.surface.mesh);
  EXPECT_EQ(report.certify.pairs, found.count);
  EXPECT_EQ(report.certify.degenerate, found.degenerate);
}

void expect_equal(const Surface& a, const Surface& b) {
  EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
  EXPECT_EQ(a.mesh.points, b.mesh.points);
  EXPECT_EQ(a.source, b.source);
}

class EverySoupInFloatingPoint : public ::testing::TestWithParam<SoupFamily> {};

TEST_P(EverySoupInFloatingPoint, BecomesAClosedManifoldByEveryRule) {
  std::size_t solids = 0;
  for (const double epsilon : kEpsilons) {
    for (std::uint64_t seed = 500; seed < 500 + share_of_cases(2u); ++seed) {
      for (const InsideRule rule :
           {InsideRule::automatic, InsideRule::solidity, InsideRule::parity, InsideRule::winding}) {
        SCOPED_TRACE(std::to_string(seed) + " " + std::string(rule_name(rule)) + ", eps " +
                     std::to_string(epsilon));
        RepairOptions options = in_floating_point(epsilon);
        options.inside.rule = rule;
        options.check_cells = rule == InsideRule::automatic;  // they are the same by every rule
        options.extract.touching = seed % 2 == 0 ? Touching::separate : Touching::join;
        const auto result = repaired(GetParam().make(seed), options);
        if (!result) continue;
        expect_true_report(*result, epsilon);
        ++solids;
      }
    }
  }
  RecordProperty("solids", static_cast<int>(solids));
}

TEST_P(EverySoupInFloatingPoint, GivesTheSameMeshInStepsAndWithAnyThreads) {
  for (const double epsilon : {kDefaultEpsilon, 1e-4}) {
    const RepairOptions options = in_floating_point(epsilon);
    for (std::uint64_t seed = 600; seed < 600 + share_of_cases(4u); ++seed) {
      SCOPED_TRACE(seed);
      const TriangleSoup soup = GetParam().make(seed);
      const auto whole = repaired(soup, options);
      const ThreadLimit one_thread(1);
      const auto again = repaired(soup, options);
      ASSERT_EQ(whole.has_value(), again.has_value());
      if (!whole) continue;
      expect_equal(whole->surface, again->surface);
      RepairReport report;
      Tree tree = parse_tree(format_tree(make_tree(soup, options, report)), "tree");
      label_tree(tree, options, report);
      expect_equal(whole->surface,
                   extract_mesh(parse_tree(format_tree(tree), "tree"), options, report));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Families, EverySoupInFloatingPoint,
                         ::testing::ValuesIn(degenerate_families()),
                         [](const auto& param_info) { return param_info.param.name; });

// The other engine leaves no trace.
TEST(FloatRepair, ExactPredicatesReportThemselves) {
  const RepairResult result = repair(cube());
  EXPECT_EQ(result.report.predicates, Predicates::exact);
  EXPECT_EQ(result.report.extract.polygons_apart, 0u);
  EXPECT_EQ(result.report.cover.guessed_facets, 0u);
}

TEST(FloatRepair, CubeStaysACube) {
  const RepairResult result = repair(cube(), in_floating_point(kDefaultEpsilon));
  EXPECT_EQ(result.surface.mesh.triangles.size(), 12u);
  EXPECT_DOUBLE_EQ(result.report.output_volume, 1);
  EXPECT_EQ(result.report.triangles.untouched, 12u);
  EXPECT_TRUE(result.report.certify.passed());
}

}  // namespace
}  // namespace meshrepair
