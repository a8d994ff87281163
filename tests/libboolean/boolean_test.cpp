// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <base/error.h>
#include <boolean/boolean.h>

#include "shapes.h"
#include "triangles_by_place.h"

namespace meshrepair {
namespace {

using namespace testing;

struct Result {
  Surface surface;
  BooleanReport report;

  [[nodiscard]] double volume() const { return signed_volume(surface.mesh); }
};

Result compute(const std::vector<TriangleSoup>& solids, SetOperation operation) {
  Result result;
  result.surface = boolean(solids, operation, {}, result.report);
  if (result.surface.mesh.triangles.empty()) return result;
  const Topology& t = result.report.result.output;
  EXPECT_TRUE(t.closed() && t.manifold() && t.oriented());
  EXPECT_TRUE(result.report.result.certify.passed());
  return result;
}

TEST(Boolean, TwoBoxesGiveTheExactVolume) {
  const std::vector<TriangleSoup> boxes = {cube(), box({0.5, 0.5, 0.5}, {2, 2, 2})};
  EXPECT_DOUBLE_EQ(compute(boxes, SetOperation::unite).volume(), 1 + 3.375 - 0.125);
  EXPECT_DOUBLE_EQ(compute(boxes, SetOperation::intersect).volume(), 0.125);
  EXPECT_DOUBLE_EQ(compute(boxes, SetOperation::subtract).volume(), 0.875);
  EXPECT_DOUBLE_EQ(compute(boxes, SetOperation::exclude).volume(), 0.875 + 3.25);
}

TEST(Boolean, UnionOfBoxesThatShareAFaceLeavesNoWall) {
  const Result united = compute({cube(), box({1, 0, 0}, {3, 1, 1})}, SetOperation::unite);
  EXPECT_DOUBLE_EQ(united.volume(), 3);
  EXPECT_EQ(united.surface.mesh.triangles.size(), 12u + 8u);
  EXPECT_EQ(united.report.result.output.parts, 1u);
}

TEST(Boolean, ResultMayBeEmptyOrTheFirst) {
  EXPECT_TRUE(compute({cube(), cube()}, SetOperation::subtract).surface.mesh.triangles.empty());
  EXPECT_TRUE(compute({cube(), {}}, SetOperation::intersect).surface.mesh.triangles.empty());
  EXPECT_TRUE(compute({{}, {}}, SetOperation::unite).surface.mesh.triangles.empty());
  const TriangleSoup ball = sphere(300);
  EXPECT_EQ(triangles_by_place(compute({ball, {}}, SetOperation::unite).surface.mesh),
            triangles_by_place(ball));
  EXPECT_EQ(triangles_by_place(compute({ball, ball}, SetOperation::intersect).surface.mesh),
            triangles_by_place(ball));
}

TEST(Boolean, TrianglesThatNothingCutsStayAsTheyAre) {
  const TriangleSoup a = sphere(2000), b = sphere(2000, 0.5, {1, 0.1, 0.2});
  const Result result = compute({a, b}, SetOperation::subtract);
  const auto before = triangles_by_place(a), after = triangles_by_place(result.surface.mesh);
  std::size_t kept = 0;
  for (const auto& t : after) kept += std::binary_search(before.begin(), before.end(), t);
  EXPECT_GT(kept, 1500u);
  bool from_both[2] = {false, false};
  for (const std::uint32_t source : result.surface.source) {
    ASSERT_LT(source, a.triangles.size() + b.triangles.size());
    from_both[source < a.triangles.size() ? 0 : 1] = true;
  }
  EXPECT_TRUE(from_both[0] && from_both[1]);
}

TEST(Boolean, ManyOperandsAreTakenInTurn) {
  std::vector<TriangleSoup> boxes;
  for (int i = 0; i < 5; ++i) boxes.push_back(moved(cube(), {0.5 * i, 0, 0}));
  EXPECT_DOUBLE_EQ(compute(boxes, SetOperation::unite).volume(), 3);
  EXPECT_DOUBLE_EQ(compute(boxes, SetOperation::subtract).volume(), 0.5);
  boxes.resize(2);
  EXPECT_DOUBLE_EQ(compute(boxes, SetOperation::intersect).volume(), 0.5);
}

// A shell around a cube, and the gap between them, are both less than a step of the grid wide.
TEST(Boolean, LayersNearerThanTheGridAreOne) {
  TriangleSoup onion = cube();
  append(onion, flipped(box(Vec3d::Constant(-1e-9), Vec3d::Constant(1 + 1e-9))));
  append(onion, box(Vec3d::Constant(-2e-9), Vec3d::Constant(1 + 2e-9)));
  const Result result = compute({onion, box({3, 3, 3}, {4, 4, 4})}, SetOperation::unite);
  EXPECT_NEAR(result.volume(), 2, 1e-6);
}

// It would come out with other measures: the first by its volume, the second by its corners.
TEST(Boolean, WhatTheCommonGridChangesIsRefused) {
  BooleanReport report;
  for (const auto& [small, large] :
       {std::pair(box({0, 0, 0}, {1, 1, 1e-7}), cube()), std::pair(cube(), scaled(cube(), 1e7))}) {
    const std::vector<TriangleSoup> solids = {small, moved(large, {3, 3, 3})};
    EXPECT_THROW((void)boolean(solids, SetOperation::unite, {}, report), InputError);
  }
}

TEST(Boolean, WhatIsNothingOnTheCommonGridIsRefused) {
  BooleanReport report;
  const std::vector<TriangleSoup> solids = {scaled(cube(), 1e12), cube()};
  EXPECT_THROW((void)boolean(solids, SetOperation::unite, {}, report), InputError);
}

}  // namespace
}  // namespace meshrepair
