// SPDX-License-Identifier: MIT
// What holds for every soup, tried on many.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include <base/error.h>
#include <bsp/tree_io.h>
#include <repair/repair.h>

#include "cells/check_complex.h"
#include "complexes.h"
#include "degenerate_soups.h"
#include "each_seed.h"
#include "share_of_cases.h"

namespace meshrepair {
namespace {

using namespace testing;

constexpr std::uint64_t kSeeds = 25;

class EverySoup : public ::testing::TestWithParam<SoupFamily> {};

double box_volume(const GridBox& b) {
  return (static_cast<double>(b.high.x) - b.low.x) * (static_cast<double>(b.high.y) - b.low.y) *
         (static_cast<double>(b.high.z) - b.low.z);
}

void expect_cells_fill_the_box(const Cells& cells) {
  const double whole = box_volume(outer_box(cells.tree->input));
  double sum = 0;
  for (CellId c(0u); c < cells.complex.cells.end_id(); ++c.value) {
    sum += cell_volume(cells.complex, c);
  }
  EXPECT_NEAR(sum, whole, 1e-9 * whole);
}

TEST_P(EverySoup, GivesASoundComplex) {
  for (std::uint64_t seed = 100; seed < 100 + share_of_cases(kSeeds); ++seed) {
    SCOPED_TRACE(seed);
    Cells cells = cells_of(GetParam().make(seed));
    EXPECT_EQ(cells.clip.fallbacks(), 0u);
    EXPECT_EQ(cells.complex.cells.size(), cells.tree->leaves.size());
    ASSERT_NO_THROW(internal::check_complex(cells.complex));
    expect_convex_cells(cells.complex);
    expect_cells_fill_the_box(cells);
    (void)cover_of(cells);
    ASSERT_NO_THROW(internal::check_complex(cells.complex));
    expect_convex_cells(cells.complex);
    expect_cells_fill_the_box(cells);
  }
}

void expect_solid(const RepairResult& result) {
  expect_closed_manifold(result.surface.mesh);
  EXPECT_TRUE(result.report.output.closed());
  EXPECT_EQ(result.report.clip.fallbacks(), 0u);
  EXPECT_EQ(result.report.tree.lost_fragments, 0u);
  EXPECT_EQ(result.surface.source.size(), result.surface.mesh.triangles.size());
  for (const Vec3d& p : result.surface.mesh.points) ASSERT_TRUE(p.allFinite());
  // Not positive only where it is thinner than the numbers tell.
  const double size = std::pow(result.report.output_area, 1.5);
  EXPECT_GT(result.report.output_volume, -1e-9 * size);
}

TEST_P(EverySoup, EveryRuleRepairsAnySoupToASolid) {
  int solids = 0;
  for (std::uint64_t seed = 200; seed < 200 + share_of_cases(kSeeds); ++seed) {
    for (const InsideRule rule :
         {InsideRule::automatic, InsideRule::solidity, InsideRule::parity, InsideRule::winding}) {
      SCOPED_TRACE(std::to_string(seed) + " " + std::string(rule_name(rule)));
      RepairOptions options;
      options.inside.rule = rule;
      options.all_cells = seed % 2 == 0;
      try {
        expect_solid(repair(GetParam().make(seed), options));
        ++solids;
      } catch (const NoSolidError&) {
        // Random triangles need not enclose anything.
      }
    }
  }
  RecordProperty("solids", solids);
}

// The steps in a row, through the file, give the bytes of the one call that makes all cells.
TEST_P(EverySoup, StepsThroughFilesGiveTheSameMesh) {
  for_each_seed(300, 6, [&](std::uint64_t seed) {
    const TriangleSoup soup = GetParam().make(seed);
    RepairReport report;
    RepairOptions by_cells;
    by_cells.all_cells = true;
    try {
      const Surface whole = repair(soup, by_cells, report);
      RepairReport steps;
      Tree tree = parse_tree(format_tree(make_tree(soup, {}, steps)), "tree");
      label_tree(tree, {}, steps);
      const Surface chained = extract_mesh(parse_tree(format_tree(tree), "tree"), {}, steps);
      EXPECT_EQ(whole.mesh.triangles, chained.mesh.triangles);
      EXPECT_EQ(whole.mesh.points, chained.mesh.points);
      EXPECT_EQ(whole.source, chained.source);
    } catch (const NoSolidError&) {
      RepairReport steps;
      Tree tree = make_tree(soup, {}, steps);
      EXPECT_THROW(label_tree(tree, {}, steps), NoSolidError);
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Families, EverySoup, ::testing::ValuesIn(degenerate_families()),
                         [](const auto& param_info) { return param_info.param.name; });

}  // namespace
}  // namespace meshrepair
