// SPDX-License-Identifier: MIT
#include "label_beside_triangles.h"

#include <gtest/gtest.h>

#include <bsp/build_tree.h>
#include <repair/repair.h>

#include "shapes.h"

namespace meshrepair {
namespace {

using namespace testing;

CleanSoup clean(const TriangleSoup& soup) {
  CleanReport report;
  return clean_soup(soup, report);
}

Tree tree_of(const TriangleSoup& soup) {
  BuildTreeReport report;
  return build_tree(clean(soup), {}, report);
}

void expect_labels_of_the_cells(const TriangleSoup& soup) {
  ASSERT_TRUE(internal::bounds_a_solid(clean(soup)));
  Tree by_cells = tree_of(soup);
  RepairOptions options;
  options.inside.rule = InsideRule::winding;
  RepairReport report;
  label_tree(by_cells, options, report);
  Tree by_triangles = tree_of(soup);
  ASSERT_TRUE(internal::label_beside_triangles(by_triangles));
  ASSERT_EQ(by_triangles.leaves.size(), by_cells.leaves.size());
  for (LeafId leaf(0u); leaf < by_cells.leaves.end_id(); ++leaf.value) {
    EXPECT_EQ(by_triangles.leaves[leaf].label, by_cells.leaves[leaf].label) << leaf.value;
  }
}

TEST(LabelBesideTriangles, LabelsAreThoseOfCells) {
  expect_labels_of_the_cells(cube());
  expect_labels_of_the_cells(sphere(3000));
  expect_labels_of_the_cells(torus(60, 30));
  Random random(5);
  expect_labels_of_the_cells(transformed(torus(40, 20), random_rotation(random)));
}

TEST(LabelBesideTriangles, KnowsCavitiesAndParts) {
  TriangleSoup soup = sphere(2000, 3);
  append(soup, flipped(sphere(1000, 2)));
  append(soup, box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}));
  append(soup, moved(cube(), {3.5, 3.5, 3.5}));
  expect_labels_of_the_cells(soup);
}

TEST(LabelBesideTriangles, PartsThatFaceEachOtherInOnePlane) {
  TriangleSoup soup = box({0, 0, 0}, {1, 1, 1});
  append(soup, box({2, 0, 1}, {3, 1, 2}));
  append(soup, box({0, 2, -1}, {1, 3, 0}));
  expect_labels_of_the_cells(soup);
}

TEST(LabelBesideTriangles, WhatIsNoSolidIsToldBefore) {
  EXPECT_FALSE(internal::bounds_a_solid(clean(flipped(cube()))));
  EXPECT_FALSE(internal::bounds_a_solid(clean(two_overlapping_spheres(1000))));
  EXPECT_FALSE(internal::bounds_a_solid(clean(without_some(sphere(1000), 0.1, 1))));
  TriangleSoup doubled = cube();
  append(doubled, flipped(cube()));
  EXPECT_FALSE(internal::bounds_a_solid(clean(doubled)));
  TriangleSoup touching = cube();
  append(touching, moved(cube(), {1, 1, 0}));
  EXPECT_FALSE(internal::bounds_a_solid(clean(touching)));
}

TEST(LabelBesideTriangles, GivesUpWhereCopiesFaceBothWays) {
  TriangleSoup doubled = cube();
  append(doubled, flipped(cube()));
  Tree tree = tree_of(doubled);
  EXPECT_FALSE(internal::label_beside_triangles(tree));
}

}  // namespace
}  // namespace meshrepair
