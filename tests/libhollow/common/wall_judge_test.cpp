// SPDX-License-Identifier: MIT
#include "common/wall_judge.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "shapes.h"

namespace meshrepair::internal {
namespace {

using testing::box;

constexpr std::uint32_t kRing = 6;

// Around a middle at z = 1; as deep as walls are to be in a box from z = 0.
std::vector<Vec3d> ring_of_points() {
  std::vector<Vec3d> points = {{10, 4, 1}};
  for (std::uint32_t i = 0; i < kRing; ++i) {
    const double angle = 2 * std::numbers::pi * i / kRing;
    points.emplace_back(10 + std::cos(angle), 4 + std::sin(angle), 1);
  }
  return points;
}

CollapseJudge::Question moved_to(const Vec3d& place) {
  CollapseJudge::Question question;
  question.place = place;
  for (std::uint32_t i = 0; i < kRing; ++i) {
    question.before.push_back({0, 1 + (i + 1) % kRing, 1 + i});
    question.after.push_back(question.before.back());
  }
  return question;
}

TEST(WallJudge, PlacesAreAsDeepAsWalls) {
  const TriangleSoup solid = box({0, 0, 0}, {20, 20, 20});
  const Depth depth(solid);
  WallJudge judge(depth, ring_of_points(), 1, 0.02);
  EXPECT_TRUE(judge.allows(moved_to({10.3, 4, 1})));
  EXPECT_TRUE(judge.allows(moved_to({10.3, 4, 1.015})));
  EXPECT_FALSE(judge.allows(moved_to({10.3, 4, 1.03})));
  EXPECT_FALSE(judge.allows(moved_to({10.3, 4, 0.97})));
}

// The places are as deep as walls, but what lies between them is not.
TEST(WallJudge, NothingDeepLeavesACavity) {
  const TriangleSoup solid = box({0, 0, 0}, {20, 20, 20});
  const Depth depth(solid);
  WallJudge judge(depth, ring_of_points(), 1, 0.02);
  EXPECT_FALSE(judge.allows(moved_to({10, 4, 19})));
}

// Beyond the ring, triangles would lie over one another.
TEST(WallJudge, NoFoldsComeToBe) {
  const TriangleSoup solid = box({0, 0, 0}, {20, 20, 20});
  const Depth depth(solid);
  WallJudge judge(depth, ring_of_points(), 1, 0.02);
  EXPECT_FALSE(judge.allows(moved_to({11.2, 4, 1})));
}

// Below the triangles there is a small void, far from their corners.
TEST(WallJudge, TrianglesAreLookedAtBetweenTheirCorners) {
  const TriangleSoup whole = box({0, 0, 0}, {20, 20, 20});
  TriangleSoup solid = whole;
  testing::append(solid, testing::flipped(box({10.99, 3.99, 0.5}, {11.01, 4.01, 0.6})));
  const Depth depth(solid);
  std::vector<Vec3d> points = ring_of_points();
  for (std::size_t i = 1; i < points.size(); ++i) points[i] += 2 * (points[i] - points[0]);
  const WallJudge::Question question = moved_to({9, 4, 1});
  EXPECT_FALSE(WallJudge(depth, points, 1, 0.02).allows(question));
  const Depth depth_of_whole(whole);
  EXPECT_TRUE(WallJudge(depth_of_whole, points, 1, 0.02).allows(question));
}

}  // namespace
}  // namespace meshrepair::internal
