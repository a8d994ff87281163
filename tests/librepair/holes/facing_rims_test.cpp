// SPDX-License-Identifier: MIT
// Walls of vessels that have lost the rim between them.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <repair/repair.h>

#include "holes/notches.h"
#include "random_geometry.h"
#include "revolved.h"

namespace meshrepair::internal {
namespace {

using namespace testing;

constexpr std::uint32_t kAroundMouth = 48;

// The triangles between the walls of a ball come last.
TriangleSoup ball_without_rim(double mouth) {
  TriangleSoup ball = pierced_shell(mouth, 0.1, kAroundMouth);
  ball.triangles.resize(ball.triangles.size() - 2 * kAroundMouth);
  return ball;
}

void expect_open(const TriangleSoup& broken, const TriangleSoup& meant, double share) {
  const RepairResult result = repair(broken);
  EXPECT_TRUE(result.report.certify.passed());
  EXPECT_EQ(result.report.output.parts, 1u);
  const double volume = signed_volume(meant);
  EXPECT_NEAR(result.report.output_volume, volume, share * volume);
}

TEST(FacingRims, RimsOfTwoWallsAreJoinedHoweverSmallTheMouthIs) {
  for (const double mouth : {0.2, 0.4, 0.7}) {
    SCOPED_TRACE(mouth);
    expect_open(ball_without_rim(mouth), pierced_shell(mouth, 0.1, kAroundMouth), 1e-9);
  }
}

// The walls are one piece, as the rim of the other mouth is there.
TEST(FacingRims, RimsOfOneOfTwoMouthsAreJoined) {
  constexpr double kEnd = std::numbers::pi - 0.4;
  Profile profile = arc(1, 0.4, kEnd, 20);
  const Profile back = arc(0.9, kEnd, 0.4, 20);
  profile.insert(profile.end(), back.begin(), back.end());
  const TriangleSoup broken = revolved(profile, kAroundMouth);
  profile.push_back(profile.front());
  TriangleSoup meant = revolved(profile, kAroundMouth);
  expect_open(broken, meant, 1e-9);
}

TEST(FacingRims, StrayTrianglesHaveNoSay) {
  TriangleSoup ball = ball_without_rim(0.5);
  Random random(3);
  for (int i = 0; i < 30; ++i) {
    const double angle = random.real(0, 2 * std::numbers::pi);
    const Vec3d at(0.47 * std::cos(angle), 0.47 * std::sin(angle), 0.82);
    const auto first = static_cast<std::uint32_t>(ball.points.size());
    for (int k = 0; k < 3; ++k) {
      const double x = random.real(-0.01, 0.01), y = random.real(-0.01, 0.01);
      ball.points.push_back(at + Vec3d(x, y, random.real(-0.01, 0.01)));
    }
    ball.triangles.push_back({first, first + 1, first + 2});
  }
  expect_open(ball, pierced_shell(0.5, 0.1, kAroundMouth), 1e-6);
}

// Two balls side by side whose holes face each other stay two.
TEST(FacingRims, RimsOfTwoBodiesAreClosed) {
  TriangleSoup ball = revolved(arc(1, 0.3, std::numbers::pi, 20), kAroundMouth);
  const std::size_t count = ball.points.size(), triangles = ball.triangles.size();
  for (std::size_t p = 0; p < count; ++p) {
    const Vec3d at = ball.points[p];
    ball.points.emplace_back(at.x(), at.y(), 2.05 - at.z());
  }
  for (std::size_t t = 0; t < triangles; ++t) {
    const auto [a, b, c] = ball.triangles[t];
    const auto shift = static_cast<std::uint32_t>(count);
    ball.triangles.push_back({a + shift, c + shift, b + shift});
  }
  EXPECT_EQ(repair(ball).report.output.parts, 2u);
}

Rim ring_with_notch() {
  Rim rim;
  for (std::uint32_t i = 0; i < 40; ++i) {
    const double angle = 2 * std::numbers::pi * i / 40;
    const double height = i == 7 ? -0.3 : 0;
    rim.points.emplace_back(std::cos(angle), std::sin(angle), height);
    const double next = angle + std::numbers::pi / 40;
    rim.apex.emplace_back(std::cos(next), std::sin(next), -1);
  }
  return rim;
}

TEST(Notches, OnlyNotchesAreFilled) {
  const FilledNotches filled = fill_notches(ring_with_notch());
  ASSERT_EQ(filled.triangles.size(), 1u);
  EXPECT_EQ(filled.triangles[0], (std::array<std::uint32_t, 3>{6, 7, 8}));
  EXPECT_EQ(filled.left.size(), 39u);
  EXPECT_EQ(filled.rim.apex[6], ring_with_notch().points[7]);
  EXPECT_GT(filled.area, 0);
}

}  // namespace
}  // namespace meshrepair::internal
