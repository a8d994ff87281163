// SPDX-License-Identifier: MIT
// Operands that touch but for small gaps.
#include <cstdint>

#include <gtest/gtest.h>

#include <boolean/boolean.h>
#include <mesh/topology.h>

#include "shapes.h"

namespace meshrepair {
namespace {

using namespace testing;

Surface combine(const TriangleSoup& a, const TriangleSoup& b, SetOperation operation, bool by_trees,
                BooleanReport& report) {
  BooleanOptions options;
  options.by_trees = by_trees;
  options.repair.join_gaps.mode = JoinGapsMode::distance;
  options.repair.join_gaps.distance = 1e-4;
  return boolean(std::vector{a, b}, operation, options, report);
}

TEST(JoinedOperands, DrillThatEndsShortGoesThrough) {
  const TriangleSoup plate = box({0, 0, 0}, {3, 3, 1});
  for (const bool by_trees : {false, true}) {
    for (const double end : {1 - 1e-5, 1 + 1e-5}) {
      BooleanReport report;
      const TriangleSoup drill = box({1, 1, -1}, {2, 2, end});
      const Surface surface = combine(plate, drill, SetOperation::subtract, by_trees, report);
      EXPECT_NEAR(signed_volume(surface.mesh), 8, 1e-3);
      EXPECT_EQ(report.result.output.parts, 1u);
      // One hole through: 16 points, 48 edges, 32 triangles.
      EXPECT_EQ(surface.mesh.points.size(), surface.mesh.triangles.size() / 2);
      for (const std::uint32_t source : surface.source) EXPECT_LT(source, 24u);
    }
  }
}

TEST(JoinedOperands, BoxesApartAreUnited) {
  BooleanReport report;
  const Surface surface = combine(box({0, 0, 0}, {1, 1, 1}), box({0, 0, 1.00001}, {1, 1, 2}),
                                  SetOperation::unite, false, report);
  EXPECT_NEAR(signed_volume(surface.mesh), 2, 1e-3);
  EXPECT_EQ(report.result.output.parts, 1u);
  EXPECT_GT(report.result.join_gaps.pairs, 0u);
}

}  // namespace
}  // namespace meshrepair
