// SPDX-License-Identifier: MIT
#include <cmath>
#include <string>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <base/error.h>
#include <repair/repair_points.h>

#include "point_clouds.h"
#include "shapes.h"

namespace meshrepair {
namespace {

using testing::sampled_at_random;
using testing::with_noise;

constexpr std::uint64_t kCloudSeed = 20261125;

struct Outcome {
  PointSolid solid;
  RepairPointsReport report;
  RepairReport repair;
  std::string why;  // there is none
};

Outcome outcome_of(const PointCloud& cloud, const RepairPointsOptions& options = {}) {
  Outcome outcome;
  try {
    outcome.solid = repair_points(cloud, options, outcome.report, outcome.repair);
  } catch (const NoSolidError& error) {
    outcome.why = error.what();
  }
  return outcome;
}

// So noisy that its triangles enclose nothing as they are.
PointCloud noisy_torus() {
  return with_noise(sampled_at_random(testing::torus(120, 60), 6000, kCloudSeed), 0.12, kCloudSeed);
}

// Points on z = height(x, y) over the unit square.
template <class Height>
PointCloud ground(std::size_t points, double noise, const Height& height) {
  testing::Random random(kCloudSeed);
  PointCloud cloud;
  for (std::size_t i = 0; i < points; ++i) {
    const double x = random.real(0, 1);
    const double y = random.real(0, 1);
    cloud.points.emplace_back(x, y, height(x, y));
  }
  return noise > 0 ? with_noise(std::move(cloud), noise, kCloudSeed) : cloud;
}

double hills(double x, double y) { return 0.1 * std::sin(7 * x) * std::cos(5 * y); }

// The side of a ball that is seen from above.
PointCloud cap(double noise) {
  PointCloud cloud;
  for (const Vec3d& p : sampled_at_random(testing::sphere(20000), 12000, kCloudSeed).points) {
    if (p.z() > 0.4) cloud.points.push_back(p);
  }
  return noise > 0 ? with_noise(std::move(cloud), noise, kCloudSeed) : cloud;
}

TEST(RepairPoints, WhatEnclosesSomethingIsTheFirstTry) {
  const Outcome outcome = outcome_of(sampled_at_random(testing::torus(120, 60), 6000, kCloudSeed));
  ASSERT_EQ(outcome.report.tries.size(), 1U);
  EXPECT_EQ(outcome.report.tries[0].end, PointTryEnd::solid);
  EXPECT_EQ(outcome.report.tries[0].project, 0);
  EXPECT_EQ(outcome.report.soup->farthest_move, 0);
  EXPECT_EQ(outcome.repair.output.parts, 1U);
}

TEST(RepairPoints, NoisyPointsAreSmoothedUntilTheyAgree) {
  const Outcome outcome = outcome_of(noisy_torus());
  ASSERT_EQ(outcome.why, "");
  const PointTry& last = outcome.report.tries.back();
  EXPECT_EQ(outcome.report.tries.front().end, PointTryEnd::open);
  EXPECT_EQ(last.end, PointTryEnd::solid);
  EXPECT_EQ(last.project, 3);
  EXPECT_GE(last.neighbours, 30U);
  EXPECT_FALSE(last.base);
  EXPECT_GE(last.agreement, 0.8);
  EXPECT_TRUE(outcome.repair.certify.passed());
  EXPECT_EQ(outcome.repair.output.parts, 1U);
  EXPECT_EQ(testing::genus_of(outcome.repair.output, outcome.solid.surface.mesh.points.size()), 1);
}

TEST(RepairPoints, TheSolidIsThatOfTheOptionsThatTheTryNames) {
  const Outcome followed = outcome_of(noisy_torus());
  RepairPointsOptions options;
  options.soup.project = followed.report.tries.back().project;
  options.soup.neighbours = followed.report.tries.back().neighbours;
  const Outcome asked = outcome_of(noisy_torus(), options);
  EXPECT_EQ(asked.report.tries.size(), 1U);
  EXPECT_EQ(asked.solid.surface.mesh.triangles, followed.solid.surface.mesh.triangles);
  EXPECT_EQ(asked.solid.surface.mesh.points, followed.solid.surface.mesh.points);
}

TEST(RepairPoints, WhatMayNotDifferStays) {
  RepairPointsOptions options;
  options.advice.neighbours = false;
  const Outcome held = outcome_of(noisy_torus(), options);
  for (const PointTry& attempt : held.report.tries) {
    EXPECT_EQ(attempt.neighbours, options.soup.neighbours);
  }
  options.advice.project = false;
  const Outcome asked = outcome_of(noisy_torus(), options);
  EXPECT_NE(asked.why, "");
  EXPECT_EQ(asked.report.tries.size(), 1U);
  options.advice.neighbours = true;
  EXPECT_EQ(outcome_of(noisy_torus(), options).report.tries.size(), 1U);
}

TEST(RepairPoints, TerrainsGetABase) {
  const Outcome outcome = outcome_of(ground(3000, 0, hills));
  ASSERT_EQ(outcome.why, "");
  ASSERT_EQ(outcome.report.tries.size(), 2U);
  EXPECT_TRUE(outcome.report.tries.back().base);
  EXPECT_EQ(outcome.report.tries.back().project, 0);
  ASSERT_TRUE(outcome.report.scan_base.has_value());
  EXPECT_EQ(outcome.report.scan_base->parts, 1U);
  EXPECT_TRUE(outcome.repair.certify.passed());
  EXPECT_GT(outcome.repair.output_volume, 0.1);
}

TEST(RepairPoints, NoisyTerrainsAreSmoothedAndGetABase) {
  const Outcome outcome = outcome_of(ground(6000, 0.008, hills));
  ASSERT_EQ(outcome.why, "");
  EXPECT_TRUE(outcome.report.tries.back().base);
  EXPECT_EQ(outcome.report.tries.back().project, 3);
  EXPECT_TRUE(outcome.repair.certify.passed());
}

TEST(RepairPoints, NoBaseWhereNoneMayBeTried) {
  RepairPointsOptions options;
  options.advice.base = false;
  const Outcome outcome = outcome_of(ground(3000, 0, hills), options);
  EXPECT_NE(outcome.why, "");
  EXPECT_EQ(outcome.report.tries.size(), 1U);
  EXPECT_FALSE(outcome.report.scan_base.has_value());
}

TEST(RepairPoints, ScansOfOneSideStayOpen) {
  for (const double noise : {0.0, 0.01, 0.03, 0.06}) {
    EXPECT_NE(outcome_of(cap(noise)).why, "") << noise;
  }
  EXPECT_NE(outcome_of(ground(3000, 0.01, [](double, double) { return 0.0; })).why, "");
}

TEST(RepairPoints, ScansOfOneSideGetAWallWhereOneIsAskedFor) {
  RepairPointsOptions options;
  options.repair.thicken.automatic = true;
  for (const double noise : {0.0, 0.01}) {
    const Outcome outcome = outcome_of(cap(noise), options);
    ASSERT_EQ(outcome.why, "") << noise;
    EXPECT_TRUE(outcome.report.tries.back().walls);
    EXPECT_TRUE(outcome.repair.certify.passed());
    EXPECT_TRUE(outcome.repair.thicken.automatic);
    EXPECT_NEAR(outcome.repair.output_volume,
                outcome.repair.thicken.area * outcome.repair.thicken.thickness,
                0.05 * outcome.repair.output_volume);
  }
}

TEST(RepairPoints, WallsAreTheLastResort) {
  RepairPointsOptions options;
  options.repair.thicken.automatic = true;
  const Outcome closed =
      outcome_of(sampled_at_random(testing::torus(120, 60), 6000, kCloudSeed), options);
  EXPECT_EQ(closed.repair.thicken.triangles, 0U);
  const Outcome terrain = outcome_of(ground(3000, 0, hills), options);
  EXPECT_TRUE(terrain.report.tries.back().base);
  EXPECT_EQ(terrain.repair.thicken.triangles, 0U);
}

TEST(RepairPoints, ThinPlatesWithTheNoiseOfTheirThicknessAreNoTerrain) {
  const PointCloud plate =
      sampled_at_random(testing::box({0, 0, 0}, {1, 1, 0.05}), 5000, kCloudSeed);
  for (const double noise : {0.014, 0.028}) {
    EXPECT_NE(outcome_of(with_noise(plate, noise, kCloudSeed)).why, "") << noise;
  }
}

TEST(RepairPoints, PointsInSpaceMakeNoSolid) {
  testing::Random random(kCloudSeed);
  PointCloud cloud;
  for (int i = 0; i < 4000; ++i) {
    cloud.points.emplace_back(random.real(0, 1), random.real(0, 1), random.real(0, 1));
  }
  const Outcome outcome = outcome_of(cloud);
  EXPECT_NE(outcome.why, "");
  EXPECT_GT(outcome.report.tries.size(), 1U);
  EXPECT_EQ(outcome.report.soup->farthest_move, 0);  // what is told is the first try
}

TEST(RepairPoints, StagesOfTriesBeforeAreOne) {
  Outcome outcome;
  outcome.repair.stages.push_back({"read", 1, 1, 1});
  outcome.solid = repair_points(ground(3000, 0, hills), {}, outcome.report, outcome.repair);
  ASSERT_GT(outcome.repair.stages.size(), 2U);
  EXPECT_EQ(outcome.repair.stages[0].name, "read");
  EXPECT_EQ(outcome.repair.stages[1].name, "tries");
}

// Rows of single precision are half a metre apart there: points move by two of them at most.
TEST(RepairPoints, ATerrainFarFromTheOriginIsWrittenInSinglePrecisionWithoutSpikes) {
  PointCloud cloud = ground(900, 0, hills);
  for (Vec3d& p : cloud.points) p = Vec3d(5e5, 5e6, 0) + 6 * p;
  RepairPointsOptions options;
  options.base = true;
  options.repair.certify.precision = Precision::float32;
  const Outcome outcome = outcome_of(cloud, options);
  ASSERT_EQ(outcome.why, "");
  EXPECT_TRUE(outcome.repair.certify.passed());
  EXPECT_LT(outcome.report.soup->points, 900U);
  Eigen::AlignedBox3d given, made;
  for (const Vec3d& p : cloud.points) given.extend(p);
  for (const Vec3d& p : outcome.solid.surface.mesh.points) made.extend(p);
  EXPECT_LT((made.max() - given.max()).maxCoeff(), 1);
  EXPECT_LT((given.min() - made.min()).head<2>().maxCoeff(), 1);
}

}  // namespace
}  // namespace meshrepair
