// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <base/error.h>
#include <boolean/merge_trees.h>
#include <bsp/common_grid.h>
#include <extract/build_cells.h>
#include <repair/repair.h>

#include "collapse_tree.h"
#include "shapes.h"

namespace meshrepair {
namespace {

using namespace testing;

Tree labelled(const TriangleSoup& soup, const Grid& grid) {
  CleanReport clean;
  BuildTreeReport built;
  Tree tree = build_tree(clean_soup(soup, grid, clean), {}, built);
  RepairOptions options;
  options.inside.rule = InsideRule::winding;
  RepairReport report;
  label_tree(tree, options, report);
  return tree;
}

// In the input's units.
double solid_volume(const Tree& tree) {
  ClipReport report;
  const CellComplex complex = build_cells(tree, {}, report);
  EXPECT_EQ(report.fallbacks(), 0u);
  double sum = 0;
  for (CellId c(0u); c < complex.cells.end_id(); ++c.value) {
    if (tree.leaves[complex.cells[c].leaf].label == Label::solid) sum += cell_volume(complex, c);
  }
  return sum * tree.input.grid.unit * tree.input.grid.unit * tree.input.grid.unit;
}

class MergeTrees : public ::testing::TestWithParam<RegionTest> {
 protected:
  double volume_of(const TriangleSoup& a, const TriangleSoup& b, SetOperation operation,
                   bool sealed) {
    const TriangleSoup* const both[] = {&a, &b};
    const Grid grid = make_grid(both);
    MergeOptions options;
    options.test = GetParam();
    options.sealed = sealed;
    return solid_volume(
        merge_trees(labelled(a, grid), labelled(b, grid), operation, options, report_));
  }

  void expect_volumes(const TriangleSoup& a, const TriangleSoup& b, double common) {
    for (const bool sealed : {false, true}) {
      const double va = signed_volume(a), vb = signed_volume(b);
      EXPECT_NEAR(volume_of(a, b, SetOperation::intersect, sealed), common, 1e-6);
      EXPECT_NEAR(volume_of(a, b, SetOperation::unite, sealed), va + vb - common, 1e-6);
      EXPECT_NEAR(volume_of(a, b, SetOperation::subtract, sealed), va - common, 1e-6);
      EXPECT_NEAR(volume_of(a, b, SetOperation::exclude, sealed), va + vb - 2 * common, 1e-6);
    }
  }

  MergeReport report_;
};

TEST_P(MergeTrees, BoxesInAllPositionsGiveTheExactVolume) {
  expect_volumes(cube(), box({0.5, 0.25, 0.125}, {2, 3, 4}), 0.5 * 0.75 * 0.875);
  expect_volumes(cube(), box({2, 0, 0}, {3, 1, 1}), 0);
  expect_volumes(cube(), box({1, 0, 0}, {2, 1, 1}), 0);       // share a face
  expect_volumes(cube(), box({1, 0.25, 0.5}, {2, 3, 3}), 0);  // part of one
  expect_volumes(cube(), box({1, 1, 0}, {2, 2, 1}), 0);       // an edge
  expect_volumes(cube(), box({1, 1, 1}, {2, 2, 2}), 0);       // a corner
  expect_volumes(cube(), box({0, 0, 0}, {1, 1, 0.5}), 0.5);   // share faces from inside
  expect_volumes(cube(), box({0.25, 0.25, 0.25}, {0.5, 0.5, 0.5}), 1.0 / 64);
  expect_volumes(cube(), cube(), 1);
}

TEST_P(MergeTrees, TreesOfEqualSolidsCollapse) {
  const TriangleSoup soup = sphere(400);
  EXPECT_EQ(volume_of(soup, soup, SetOperation::subtract, true), 0);
  EXPECT_EQ(report_.kept_nodes, 0u);
}

TEST_P(MergeTrees, VolumesOfSpheresAddUp) {
  const TriangleSoup a = sphere(800), b = sphere(600, 0.8, {0.7, 0.2, 0.1});
  const double both = volume_of(a, b, SetOperation::intersect, true);
  EXPECT_GT(both, 0.3);
  expect_volumes(a, b, both);
}

TEST(MergeTreesOf, DifferentGridsAreRefused) {
  MergeReport report;
  const TriangleSoup soup = cube();
  const Grid grid = make_grid({0, 0, 0}, {1, 1, 1}), other = make_grid({0, 0, 0}, {9, 9, 9});
  EXPECT_THROW((void)merge_trees(labelled(soup, grid), labelled(soup, other), SetOperation::unite,
                                 {}, report),
               InputError);
}

TEST(MergeTreesOf, TreesWithoutLabelsAreRefused) {
  MergeReport report;
  RepairReport repair_report;
  const Tree tree = make_tree(cube(), {}, repair_report);
  EXPECT_THROW((void)merge_trees(tree, tree, SetOperation::unite, {}, report), InputError);
}

INSTANTIATE_TEST_SUITE_P(Tests, MergeTrees,
                         ::testing::Values(RegionTest::cells, RegionTest::linear_programs),
                         [](const auto& test) {
                           return test.param == RegionTest::cells ? "Cells" : "LinearPrograms";
                         });

}  // namespace
}  // namespace meshrepair
