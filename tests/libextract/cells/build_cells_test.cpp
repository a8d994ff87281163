// SPDX-License-Identifier: MIT
#include <string>

#include <gtest/gtest.h>

#include <base/error.h>
#include <extract/build_cells.h>

#include "cells/check_complex.h"
#include "shapes.h"
#include "share_of_cases.h"
#include "trees.h"
#include "unreliable_engine.h"

namespace meshrepair {
namespace {

using namespace testing;

struct Case {
  std::string name;
  TriangleSoup soup;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

double box_volume(const GridBox& b) {
  return (static_cast<double>(b.high.x) - b.low.x) * (static_cast<double>(b.high.y) - b.low.y) *
         (static_cast<double>(b.high.z) - b.low.z);
}

class BuildCells : public ::testing::TestWithParam<Case> {};

TEST_P(BuildCells, CellsAreSpheresThatFillTheBox) {
  BuildTreeReport tree_report;
  const Tree tree = tree_of(GetParam().soup, tree_report);
  EXPECT_EQ(tree_report.lost_fragments, 0u);
  ClipReport report;
  const CellComplex complex = build_cells(tree, {}, report);
  EXPECT_EQ(report.fallbacks(), 0u);
  EXPECT_EQ(complex.cells.size(), tree.leaves.size());
  EXPECT_NO_THROW(internal::check_complex(complex));
  const double whole = box_volume(outer_box(tree.input));
  double sum = 0;
  for (CellId c(0u); c < complex.cells.end_id(); ++c.value) {
    const double volume = cell_volume(complex, c);
    EXPECT_GT(volume, -1e-9 * whole);
    sum += volume;
  }
  EXPECT_NEAR(sum, whole, 1e-9 * whole);
}

std::vector<Case> cases() {
  std::vector<Case> all = {{"Cube", cube()},
                           {"Sphere", sphere(2000)},
                           {"Torus", torus(30, 20)},
                           {"Spheres", two_overlapping_spheres(2000)},
                           {"Cubes", random_cubes(30, 1)},
                           {"NoisySphere", noisy_sphere(1000, 0.2, 1)},
                           {"Flat", TriangleSoup{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}},
                           {"Empty", TriangleSoup{}}};
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const std::string n = std::to_string(seed);
    all.push_back({"GridBoxes" + n, random_grid_boxes(10, 6, seed)});
    all.push_back({"GridSoup" + n, random_soup(60, 4, seed)});
    all.push_back({"Soup" + n, random_soup(40, 100000, seed)});
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(Shapes, BuildCells, ::testing::ValuesIn(cases()),
                         [](const auto& param_info) { return param_info.param.name; });

TEST(BuildCells, InvariantsHoldAfterEveryClip) {
  BuildTreeReport tree_report;
  const Tree tree = tree_of(random_grid_boxes(6, 5, 3), tree_report);
  ClipReport report;
  BuildCellsOptions options;
  options.check_every_clip = true;
  EXPECT_NO_THROW((void)build_cells(tree, options, report));
  EXPECT_GT(report.clips, 0u);
}

// Below the plane that a facet lies in as well as above it.
TEST(BuildCells, PlaneOfTheRegionsOwnFacetIsRefused) {
  for (const std::size_t side : {0u, 1u}) {
    BuildTreeReport tree_report;
    Tree tree = tree_of(cube(), tree_report);
    const PlaneId plane = tree.nodes[NodeId(0u)].plane;
    tree.nodes.clear();
    tree.leaves.assign(3, {});
    TreeNode root;
    root.plane = plane;
    root.child[side] = TreeRef(NodeId(1u));
    root.child[1 - side] = TreeRef(LeafId(0u));
    tree.nodes.push_back(root);
    TreeNode again;
    again.plane = plane;
    again.child = {TreeRef(LeafId(1u)), TreeRef(LeafId(2u))};
    tree.nodes.push_back(again);
    ClipReport report;
    EXPECT_THROW((void)build_cells(tree, {}, report), InputError);
  }
}

TEST(Clipper, TopologySurvivesWrongPredicates) {
  ClipReport total;
  for (std::uint64_t seed = 0; seed < share_of_cases(60u); ++seed) {
    BuildTreeReport tree_report;
    const Tree tree = tree_of(seed % 2 == 0 ? random_soup(25, 5, seed) : sphere(24), tree_report);
    UnreliableEngine engine(seed, seed % 3 == 0 ? 0.02 : seed % 3 == 1 ? 0.3 : 1.0);
    BuildCellsOptions options;
    options.engine = &engine;
    options.check_every_clip = true;
    ClipReport report;
    CellComplex complex = build_cells(tree, options, report);
    EXPECT_NO_THROW(internal::check_complex(complex));
    EXPECT_EQ(complex.cells.size(), tree.leaves.size());
    total.several_groups += report.several_groups;
    total.region_floods += report.region_floods;
    total.several_regions += report.several_regions;
    total.forced_cuts += report.forced_cuts;
  }
  // Every branch was taken.
  EXPECT_GT(total.several_groups, 0u);
  EXPECT_GT(total.region_floods, 0u);
  EXPECT_GT(total.several_regions, 0u);
  EXPECT_GT(total.forced_cuts, 0u);
}

}  // namespace
}  // namespace meshrepair
