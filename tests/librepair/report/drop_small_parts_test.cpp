// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <repair/keep_parts.h>
#include <repair/repair.h>

#include "shapes.h"

namespace meshrepair {
namespace {

TEST(DropSmallParts, DropsPartsWithFewTriangles) {
  TriangleSoup soup = testing::sphere(500);
  testing::append(soup, testing::moved(testing::cube(), {5, 0, 0}));
  RepairResult result = repair(soup);
  ASSERT_EQ(result.report.output.parts, 2U);
  const double volume = result.report.output_volume;
  EXPECT_EQ(drop_small_parts(result.surface, 20, result.report), 1U);
  EXPECT_EQ(result.report.output.parts, 1U);
  EXPECT_NEAR(result.report.output_volume, volume - 1, 1e-9);
  EXPECT_EQ(result.surface.source.size(), result.surface.mesh.triangles.size());
  EXPECT_EQ(result.surface.input_point.size(), result.surface.mesh.points.size());
}

TEST(DropSmallParts, KeepsTheOnlyPart) {
  RepairResult result = repair(testing::cube());
  EXPECT_EQ(drop_small_parts(result.surface, 20, result.report), 0U);
  EXPECT_EQ(result.surface.mesh.triangles.size(), 12U);
}

}  // namespace
}  // namespace meshrepair
