// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include <base/error.h>
#include <hollow/offset.h>
#include <mesh/topology.h>

#include "shapes.h"

namespace meshrepair {
namespace {

using testing::append;
using testing::box;
using testing::sphere;

constexpr double kPi = std::numbers::pi;

struct Moved {
  RepairReport report;
  OffsetReport offset;
  Surface surface;
};

Moved moved(const TriangleSoup& soup, double distance) {
  Moved result;
  RepairOptions options;
  options.certify.precision = Precision::float32;
  options.certify.welded = true;
  const Surface solid = repair(soup, options, result.report);
  result.surface = offset(solid, distance, options, result.offset, result.report);
  return result;
}

void expect_proven(const Moved& result) {
  const double distance = std::abs(result.offset.distance);
  EXPECT_TRUE(result.report.certify.passed());
  EXPECT_EQ(result.offset.unproven, 0u);
  EXPECT_GE(result.offset.least, distance * (1 - kHollowError));
  EXPECT_LE(result.offset.most, distance * (1 + kHollowError));
  EXPECT_EQ(result.report.output_volume, signed_volume(result.surface.mesh));
}

// Steiner's formula.
TEST(Offset, OutwardEdgesAreRound) {
  const Moved result = moved(box({0, 0, 0}, {20, 30, 10}), 2);
  expect_proven(result);
  EXPECT_NEAR(result.report.output_volume, 6000 + 2200 * 2 + 60 * kPi * 4 + 4 * kPi * 8 / 3, 40);
  EXPECT_EQ(result.offset.volume_before, 6000);
  EXPECT_EQ(result.report.output.parts, 1u);
}

TEST(Offset, InwardEdgesStaySharp) {
  const Moved result = moved(box({0, 0, 0}, {20, 30, 10}), -2);
  expect_proven(result);
  EXPECT_NEAR(result.report.output_volume, 16 * 26 * 6, 20);
}

TEST(Offset, VoidsBecomeSmallerOutwardAndLargerInward) {
  TriangleSoup shell = sphere(500);
  append(shell, testing::flipped(sphere(500, 0.5)));
  const auto ball = [](double radius) { return 4 * kPi / 3 * radius * radius * radius; };
  const Moved outward = moved(shell, 0.2);
  expect_proven(outward);
  EXPECT_EQ(outward.report.output.parts, 2u);
  EXPECT_NEAR(outward.report.output_volume, ball(1.2) - ball(0.3), 0.2);
  const Moved inward = moved(shell, -0.2);
  expect_proven(inward);
  EXPECT_NEAR(inward.report.output_volume, ball(0.8) - ball(0.7), 0.2);
  const Moved filled = moved(shell, 0.6);
  expect_proven(filled);
  EXPECT_EQ(filled.report.output.parts, 1u);
}

TEST(Offset, BodiesGrowTogetherAndPartsApart) {
  TriangleSoup two = box({0, 0, 0}, {4, 4, 4});
  append(two, box({5, 0, 0}, {9, 4, 4}));
  EXPECT_EQ(moved(two, 1).report.output.parts, 1u);
  TriangleSoup bar = two;
  append(bar, box({3, 1.8, 1.8}, {6, 2.2, 2.2}));
  EXPECT_EQ(moved(bar, -0.4).report.output.parts, 2u);
}

TEST(Offset, TheSameAfterScalingByAPowerOfTwo) {
  const Moved one = moved(sphere(300), 0.25);
  const Moved large = moved(testing::scaled(sphere(300), 64), 16);
  ASSERT_EQ(one.surface.mesh.points.size(), large.surface.mesh.points.size());
  for (std::size_t i = 0; i < one.surface.mesh.points.size(); ++i) {
    ASSERT_EQ(64 * one.surface.mesh.points[i], large.surface.mesh.points[i]);
  }
  EXPECT_EQ(one.surface.mesh.triangles, large.surface.mesh.triangles);
}

TEST(Offset, SaysWhatIsOutOfRange) {
  const TriangleSoup cube = box({0, 0, 0}, {1, 1, 1});
  EXPECT_THROW((void)moved(cube, 0), UsageError);
  EXPECT_THROW((void)moved(cube, std::numeric_limits<double>::infinity()), UsageError);
  EXPECT_THROW((void)moved(cube, 1e-6), ValueError);
  EXPECT_THROW((void)moved(cube, 1e155), ValueError);
  EXPECT_THROW((void)moved(testing::moved(cube, {1e5, 1e5, 1e5}), 0.1), ValueError);
  EXPECT_THROW((void)moved(cube, -0.5), NoSolidError);
}

}  // namespace
}  // namespace meshrepair
