// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <base/error.h>
#include <hollow/hollow.h>
#include <mesh/topology.h>

#include "shapes.h"

namespace meshrepair {
namespace {

using testing::append;
using testing::box;
using testing::sphere;

struct Hollowed {
  RepairReport report;
  HollowReport hollow;
  Surface solid, surface;
};

Hollowed hollowed(const TriangleSoup& soup, const HollowOptions& options) {
  Hollowed result;
  RepairOptions repair_options;
  repair_options.certify.precision = Precision::float32;
  repair_options.certify.welded = true;
  result.solid = repair(soup, repair_options, result.report);
  result.surface = hollow(result.solid, options, repair_options, result.hollow, result.report);
  return result;
}

HollowOptions wall_of(double wall, double drain = 0) {
  HollowOptions options;
  options.wall = wall;
  options.drain = drain;
  return options;
}

void expect_within_bounds(const HollowReport& hollow) {
  EXPECT_EQ(hollow.unproven, 0u);
  EXPECT_GE(hollow.least, hollow.wall * (1 - kHollowError));
  EXPECT_LE(hollow.most, hollow.wall * (1 + kHollowError));
}

TEST(Hollow, WallsHaveTheirThickness) {
  const Hollowed result = hollowed(box({0, 0, 0}, {20, 30, 10}), wall_of(1));
  EXPECT_TRUE(result.report.certify.passed());
  expect_within_bounds(result.hollow);
  ASSERT_EQ(result.hollow.cavities.size(), 1u);
  EXPECT_NEAR(result.hollow.cavities[0].volume, 4032, 1);
  EXPECT_NEAR(signed_volume(result.surface.mesh), 6000 - 4032, 1);
  EXPECT_FALSE(result.hollow.cavities[0].opens);
  EXPECT_EQ(result.report.output.parts, 2u);
  EXPECT_NEAR(result.report.output_volume, 6000 - 4032, 1);
}

// Single precision moves walls by more there; they are made so much better before.
TEST(Hollow, WallsHaveTheirThicknessFarFromTheOrigin) {
  const Hollowed result = hollowed(testing::moved(sphere(500), {100, 100, 100}), wall_of(0.1));
  EXPECT_TRUE(result.report.certify.passed());
  expect_within_bounds(result.hollow);
}

TEST(Hollow, DrainsOpenTheCavity) {
  const Hollowed result = hollowed(sphere(2000), wall_of(0.1, 0.2));
  EXPECT_TRUE(result.report.certify.passed());
  expect_within_bounds(result.hollow);
  ASSERT_EQ(result.hollow.cavities.size(), 1u);
  EXPECT_EQ(result.hollow.cavities[0].drains.size(), 2u);
  EXPECT_TRUE(result.hollow.cavities[0].opens);
  EXPECT_EQ(result.report.output.parts, 1u);
}

TEST(Hollow, TheOuterSurfaceStaysBitForBit) {
  const Hollowed result = hollowed(sphere(800), wall_of(0.2));
  std::size_t same = 0;
  for (std::size_t t = 0; t < result.surface.source.size(); ++t) {
    const std::uint32_t source = result.surface.source[t];
    if (source == Surface::kNoSource) continue;
    ++same;
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(result.surface.mesh.points[result.surface.mesh.triangles[t][k]],
                result.solid.mesh.points[result.solid.mesh.triangles[source][k]]);
    }
  }
  EXPECT_EQ(same, result.solid.mesh.triangles.size());
}

TEST(Hollow, SmallCavitiesStayFull) {
  TriangleSoup soup = box({0, 0, 0}, {10, 10, 10});
  append(soup, box({20, 0, 0}, {22.5, 10, 10}));
  const Hollowed result = hollowed(soup, wall_of(1, 1));
  ASSERT_EQ(result.hollow.cavities.size(), 1u);
  EXPECT_EQ(result.hollow.left_full, 1u);
  EXPECT_NEAR(result.hollow.left_full_volume, 0.5 * 8 * 8, 0.5);
}

TEST(Hollow, NothingIsDeepEnough) {
  const Hollowed result = hollowed(box({0, 0, 0}, {10, 10, 1}), wall_of(3, 1));
  EXPECT_TRUE(result.hollow.cavities.empty());
  EXPECT_EQ(result.surface.mesh.triangles, result.solid.mesh.triangles);
}

TEST(Hollow, DrainsAreWhereTheyAreAskedFor) {
  HollowOptions options = wall_of(1, 2);
  options.drains_at = {Vec3d(10, 15, 100), Vec3d(-5, 15, 5)};
  const Hollowed result = hollowed(box({0, 0, 0}, {20, 30, 10}), options);
  ASSERT_EQ(result.hollow.cavities.size(), 1u);
  ASSERT_EQ(result.hollow.cavities[0].drains.size(), 2u);
  EXPECT_EQ(result.hollow.cavities[0].drains[0].at, Vec3d(10, 15, 10));
  EXPECT_EQ(result.hollow.cavities[0].drains[1].at, Vec3d(0, 15, 5));
  EXPECT_TRUE(result.hollow.cavities[0].opens);
}

// Without walls beside drains, points would be near an edge, which is near two faces.
TEST(Hollow, DrainsLeaveWallsBesideThem) {
  const Hollowed result = hollowed(box({0, 0, 0}, {10, 10, 4}), wall_of(0.5, 2));
  EXPECT_TRUE(result.report.certify.passed());
  ASSERT_EQ(result.hollow.cavities.size(), 1u);
  EXPECT_EQ(result.hollow.cavities[0].drains.size(), 2u);
  EXPECT_GE(result.hollow.beside_drains, 0.5 * (1 - kHollowError));
  EXPECT_LE(result.hollow.beside_drains, 0.5);
  // A drain is near the side that it goes through, and near no other one.
  for (const Vec3d& p : result.surface.mesh.points) {
    int near = 0;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const double high = Vec3d(10, 10, 4)[k];
      near += p[k] < 0.48 || p[k] > high - 0.48 ? 1 : 0;
    }
    EXPECT_TRUE(near <= 1 || near == 3) << p;
  }
}

TEST(Hollow, DrainsThatOverlapAreRefused) {
  HollowOptions options = wall_of(0.5, 1);
  options.drains_at = {Vec3d(5, 5, 0), Vec3d(5.5, 5, 0)};
  EXPECT_THROW((void)hollowed(box({0, 0, 0}, {10, 10, 4}), options), ValueError);
  options.drains_at = {Vec3d(5, 5, 0), Vec3d(5, 5, 4)};
  EXPECT_EQ(hollowed(box({0, 0, 0}, {10, 10, 4}), options).hollow.cavities[0].drains.size(), 2u);
}

TEST(Hollow, OptionsOutOfRangeAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double wall : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW((void)hollowed(sphere(100), wall_of(wall)), UsageError);
  }
  EXPECT_THROW((void)hollowed(sphere(100), wall_of(0.1, -1)), UsageError);
  EXPECT_THROW((void)hollowed(sphere(100), wall_of(0.1, nan)), UsageError);
  EXPECT_THROW((void)hollowed(sphere(100), wall_of(1e-9)), ValueError);
  EXPECT_THROW((void)hollowed(sphere(100), wall_of(0.1, 1e-9)), ValueError);
  HollowOptions options = wall_of(0.1);
  options.drains_at = {Vec3d::Zero()};
  EXPECT_THROW((void)hollowed(sphere(100), options), UsageError);
}

}  // namespace
}  // namespace meshrepair
