// SPDX-License-Identifier: MIT
// Without trees the result is that of merged trees.
#include "boolean_chambers.h"

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "random_solids.h"
#include "shapes.h"
#include "share_of_cases.h"

namespace meshrepair {
namespace {

using namespace testing;

constexpr SetOperation kAll[] = {SetOperation::unite, SetOperation::intersect,
                                 SetOperation::subtract, SetOperation::exclude};

// Whether trees are not needed.
bool is_as_by_trees(const std::vector<TriangleSoup>& solids, SetOperation operation) {
  BooleanReport report, of_trees;
  const std::optional<Surface> surface =
      internal::boolean_by_chambers(solids, operation, {}, report);
  if (!surface) return false;
  BooleanOptions options;
  options.by_trees = true;
  const Surface other = boolean(solids, operation, options, of_trees);
  const double volume = signed_volume(other.mesh);
  EXPECT_NEAR(signed_volume(surface->mesh), volume, 1e-9 * std::abs(volume));
  EXPECT_NEAR(surface_area(surface->mesh), surface_area(other.mesh),
              1e-9 * surface_area(other.mesh));
  EXPECT_EQ(report.result.output.parts, of_trees.result.output.parts);
  EXPECT_EQ(report.result.parts.bounding_triangles, of_trees.result.parts.bounding_triangles);
  if (!surface->mesh.triangles.empty()) {
    EXPECT_TRUE(report.result.certify.passed());
  }
  return true;
}

TEST(BooleanChambers, PairsOfSolidsAreAsByTrees) {
  std::size_t without = 0;
  for (std::uint64_t seed = 1; seed <= share_of_cases(60u); ++seed) {
    SCOPED_TRACE(seed);
    const SetOperation operation = kAll[seed % 4];
    SCOPED_TRACE(operation_name(operation));
    without += is_as_by_trees(random_pair(seed), operation) ? 1 : 0;
  }
  EXPECT_GE(without, expected_cases(40u));
}

TEST(BooleanChambers, ManySolidsAreTakenInTurn) {
  for (const SetOperation operation : kAll) {
    SCOPED_TRACE(operation_name(operation));
    std::vector<TriangleSoup> solids;
    for (int i = 0; i < 5; ++i) {
      solids.push_back(moved(sphere(80), {0.7 * i, 0.21 * i, 0}));
    }
    EXPECT_TRUE(is_as_by_trees(solids, operation));
  }
}

// Faces that both have, alike or the other way round, and solids that are equal.
TEST(BooleanChambers, FacesInCommonAreTakenFromEachSolid) {
  const TriangleSoup first = cube(), beside = moved(cube(), {1, 0, 0});
  const TriangleSoup half = box({0, 0, 0}, {0.5, 1, 1});
  for (const SetOperation operation : kAll) {
    SCOPED_TRACE(operation_name(operation));
    EXPECT_TRUE(is_as_by_trees({first, beside}, operation));
    EXPECT_TRUE(is_as_by_trees({first, first}, operation));
    EXPECT_TRUE(is_as_by_trees({first, half}, operation));
    EXPECT_TRUE(is_as_by_trees({half, first}, operation));
  }
}

TEST(BooleanChambers, CellsGiveTheSame) {
  for (std::uint64_t seed = 1; seed <= share_of_cases(40u); ++seed) {
    SCOPED_TRACE(seed);
    const SetOperation operation = kAll[seed % 4];
    SCOPED_TRACE(operation_name(operation));
    BooleanReport report, of_trees;
    BooleanOptions options;
    const Surface surface =
        internal::boolean_by_cells(random_pair(seed), operation, options, report);
    options.by_trees = true;
    const Surface other = boolean(random_pair(seed), operation, options, of_trees);
    const double volume = signed_volume(other.mesh), area = surface_area(other.mesh);
    EXPECT_NEAR(signed_volume(surface.mesh), volume, 1e-9 * std::abs(volume));
    EXPECT_NEAR(surface_area(surface.mesh), area, 1e-9 * area);
    EXPECT_EQ(report.result.output.parts, of_trees.result.output.parts);
  }
}

// On the grid of all, the sphere's triangles are a few steps large, and fold over each other.
TEST(BooleanChambers, WhatRoundingFoldsTakesNoTrees) {
  const TriangleSoup small = scaled(sphere(2000), 2e-6);
  const TriangleSoup large = box({0, -2, -2}, {4, 2, 2});
  for (const SetOperation operation : kAll) {
    SCOPED_TRACE(operation_name(operation));
    BooleanReport report;
    const Surface surface = boolean(std::vector{small, large}, operation, {}, report);
    EXPECT_TRUE(report.merges.empty());
    EXPECT_TRUE(report.result.certify.passed());
    EXPECT_GT(signed_volume(surface.mesh), 0);
  }
}

TEST(BooleanChambers, AskingForARegionTestGivesTrees) {
  BooleanOptions options;
  BooleanReport report;
  (void)boolean(std::vector{cube(), moved(cube(), {0.5, 0.5, 0.5})}, SetOperation::unite, options,
                report);
  EXPECT_EQ(report.merges.size(), 0u);
  options.test = RegionTest::linear_programs;
  (void)boolean(std::vector{cube(), moved(cube(), {0.5, 0.5, 0.5})}, SetOperation::unite, options,
                report);
  EXPECT_EQ(report.merges.size(), 1u);
}

TEST(BooleanChambers, AnEmptySolidTakesPart) {
  for (const SetOperation operation : kAll) {
    SCOPED_TRACE(operation_name(operation));
    EXPECT_TRUE(is_as_by_trees({cube(), TriangleSoup()}, operation));
    EXPECT_TRUE(is_as_by_trees({TriangleSoup(), cube()}, operation));
  }
}

}  // namespace
}  // namespace meshrepair
