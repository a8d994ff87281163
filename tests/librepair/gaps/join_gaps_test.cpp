// SPDX-License-Identifier: MIT
// Bodies that touch but for small gaps.
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <base/error.h>
#include <mesh/topology.h>
#include <repair/join_gaps.h>
#include <repair/repair.h>

#include "each_seed.h"
#include "shapes.h"

namespace meshrepair {
namespace {

using namespace testing;

JoinGapsOptions over(double distance) { return {JoinGapsMode::distance, distance, false, nullptr}; }

RepairReport joined(const TriangleSoup& soup, const JoinGapsOptions& gaps,
                    Surface* surface = nullptr) {
  RepairOptions options;
  options.join_gaps = gaps;
  RepairReport report;
  Surface result = repair(soup, options, report);
  EXPECT_TRUE(report.output.closed() && report.output.manifold() && report.output.oriented());
  EXPECT_TRUE(report.kept_valid || report.certify.passed());
  EXPECT_EQ(report.join_gaps.left, 0u);
  if (surface != nullptr) *surface = std::move(result);
  return report;
}

TriangleSoup noisy(TriangleSoup soup, double noise, std::mt19937& random) {
  std::uniform_real_distribution<double> real(-noise, noise);
  for (Vec3d& p : soup.points) p += Vec3d(real(random), real(random), real(random));
  return soup;
}

TriangleSoup bricks(std::int32_t count, double noise, std::uint64_t seed) {
  std::mt19937 random(seed);
  TriangleSoup all;
  for (std::int32_t x = 0; x < count; ++x) {
    for (std::int32_t y = 0; y < count; ++y) {
      for (std::int32_t z = 0; z < count; ++z) {
        append(all, noisy(box(Vec3d(x, y, z), Vec3d(x + 1, y + 1, z + 1)), noise, random));
      }
    }
  }
  return placed(all, seed);
}

std::string refusal_of(const TriangleSoup& soup, double distance) {
  JoinGapsReport report;
  try {
    (void)join_gaps(soup, over(distance), report);
  } catch (const ValueError& error) {
    return error.what();
  }
  return "none";
}

TEST(JoinGaps, BoxesOnEachOtherAreOnePart) {
  const double size = 1.0;
  for (const double apart : {1e-8, 1e-5, 1e-3, -1e-5}) {
    const TriangleSoup soup =
        together(box({0, 0, 0}, {3, 3, 1}), box({1, 1, 1 + apart}, {2, 2, 2 + apart}));
    const RepairReport report = joined(soup, over(2e-3));
    EXPECT_EQ(report.output.parts, 1u) << apart;
    EXPECT_NEAR(report.output_area, 34, 1e-2) << apart;
    EXPECT_NEAR(report.output_volume, 9 + size, 1e-2) << apart;
    EXPECT_NEAR(report.join_gaps.widest_gap, std::abs(apart), 1e-12);
    EXPECT_LE(report.join_gaps.farthest_move, 2 * std::abs(apart));
  }
}

TEST(JoinGaps, FacesStayInOnePlane) {
  const TriangleSoup soup = together(box({0, 0, 0}, {3, 3, 1}), box({1, 1, 1.00001}, {2, 2, 2}));
  Surface surface;
  (void)joined(soup, over(1e-4), &surface);
  for (const Vec3d& p : surface.mesh.points) {
    EXPECT_TRUE(p.z() == 0 || p.z() == 1 || p.z() == 2) << p.z();
  }
}

TEST(JoinGaps, NoisyBricksAreOneBlock) {
  for_each_seed(20, [](std::uint64_t seed) {
    const double noise = std::pow(10, -4 - static_cast<double>(seed % 5));
    for (const JoinGapsOptions& options :
         {over(4 * noise), JoinGapsOptions{JoinGapsMode::automatic, 0, false, nullptr}}) {
      const RepairReport report = joined(bricks(3, noise, seed), options);
      EXPECT_EQ(report.output.parts, 1u);
      EXPECT_NEAR(report.output_area, 54, 0.1);
      EXPECT_EQ(report.output.triangles, 108u);
    }
  });
}

TEST(JoinGaps, WhatHasNoGapsIsLeftAlone) {
  JoinGapsReport report;
  const JoinGapsOptions automatic{JoinGapsMode::automatic, 0, false, nullptr};
  for (const TriangleSoup& soup : {cube(), torus(40, 20), two_overlapping_spheres(500)}) {
    EXPECT_FALSE(join_gaps(soup, automatic, report).has_value());
    EXPECT_FALSE(join_gaps(soup, over(1e-9), report).has_value());
  }
}

TEST(JoinGaps, MoreThanHalfOfAWallIsRefused) {
  const TriangleSoup soup =
      together(box({0, 0, 0}, {3, 3, 1}), box({0, 0, 1.00001}, {3, 3, 1.01001}));
  EXPECT_EQ(refusal_of(soup, 0.02).substr(0, 66),
            "gaps of 0.02 cannot be joined: the mesh has a wall of only 0.01 at");
  EXPECT_NE(refusal_of(soup, 0.02).find("the largest distance that would do is 0.005"),
            std::string::npos);
  EXPECT_EQ(refusal_of(soup, 0.005), "none");
}

TEST(JoinGaps, TrianglesKnowWhichOneTheyWere) {
  const TriangleSoup soup = together(box({0, 0, 0}, {3, 3, 1}), box({1, 1, 1.00001}, {2, 2, 2}));
  Surface surface;
  const RepairReport report = joined(soup, over(1e-4), &surface);
  for (std::size_t t = 0; t < surface.source.size(); ++t) {
    ASSERT_LT(surface.source[t], soup.triangles.size());
    const auto normal = [](const TriangleSoup& of, std::size_t i) {
      const auto& c = of.triangles[i];
      const Vec3d& a = of.points[c[0]];
      return Vec3d((of.points[c[1]] - a).cross(of.points[c[2]] - a).normalized());
    };
    EXPECT_GT(normal(surface.mesh, t).dot(normal(soup, surface.source[t])), 0.999);
  }
  EXPECT_EQ(report.triangles.untouched, 12u);
}

TEST(JoinGaps, ProposalIsTheWidestGapOfMany) {
  const GapProposal proposal = propose_gaps(bricks(3, 1e-6, 5), nullptr);
  EXPECT_GT(proposal.pairs, 54u);
  EXPECT_GT(proposal.widest_gap, 1e-6);
  EXPECT_LT(proposal.widest_gap, 4e-6);
  EXPECT_EQ(proposal.distance, 2 * proposal.widest_gap);
}

}  // namespace
}  // namespace meshrepair
