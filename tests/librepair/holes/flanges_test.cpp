// SPDX-License-Identifier: MIT
#include "holes/flanges.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <repair/repair.h>

#include "revolved.h"
#include "trees.h"

namespace meshrepair::internal {
namespace {

using namespace testing;

constexpr std::uint32_t kAround = 24;

// A cup of radius 1, open at height 0, with a flange up to radius 1.3 that has waves.
TriangleSoup cup_with_flange(double waves, double depth = 1) {
  TriangleSoup soup = revolved({{1.3, 0}, {1.15, 0}, {1, 0}, {1, -depth}, {0, -depth}}, kAround);
  for (Vec3d& p : soup.points) {
    const double out = std::max(0.0, std::hypot(p.x(), p.y()) - 1) / 0.3;
    p.z() += waves * out * std::sin(3 * std::atan2(p.y(), p.x()));
  }
  return soup;
}

double area_of_cup() { return kAround * 0.5 * std::sin(2 * std::numbers::pi / kAround); }

Flanges flanges_of(const TriangleSoup& soup) {
  const CleanSoup clean = cleaned(soup);
  const std::vector<IndexTriangle> triangles = index_triangles(clean);
  const EdgeTable table(triangles);
  const BoundaryLoops loops = find_boundary_loops(clean, triangles, table, nullptr);
  return find_flanges(clean, triangles, table, loops, nullptr);
}

TEST(Flanges, BeginWhereTheCupEnds) {
  for (const double waves : {0.0, 0.1}) {
    const Flanges found = flanges_of(cup_with_flange(waves));
    ASSERT_EQ(found.openings.loops(), 1u);
    EXPECT_EQ(found.openings.points_of(0).size(), kAround);
    EXPECT_EQ(found.is_outer_rim, std::vector<char>{1});
  }
}

// What is flat around a hill has more area than the hill.
TEST(Flanges, FlangesAreNoGround) {
  EXPECT_TRUE(
      flanges_of(revolved({{3, 0}, {1, 0}, {1, 0.2}, {0, 0.2}}, kAround)).is_outer_rim.empty());
  EXPECT_TRUE(flanges_of(revolved({{1, 0}, {0.5, 0.2}, {0, 0.3}}, kAround)).is_outer_rim.empty());
  EXPECT_TRUE(flanges_of(revolved({{1, 0}, {1, -1}, {0, -1}}, kAround)).is_outer_rim.empty());
}

// A hole in the flange that reaches the cup.
TEST(Flanges, FlangesMayHaveHoles) {
  TriangleSoup soup = cup_with_flange(0);
  const auto first = soup.triangles.begin() + 2 * (kAround + 5);
  soup.triangles.erase(first, first + 2);
  EXPECT_EQ(flanges_of(soup).openings.points_of(0).size(), kAround);
  EXPECT_NEAR(repair(soup).report.output_volume, area_of_cup(), 1e-6);
}

TEST(Flanges, CupIsClosedAsWithoutItsFlange) {
  for (const double waves : {0.0, 0.1, -0.15}) {
    SCOPED_TRACE(waves);
    const RepairResult result = repair(cup_with_flange(waves));
    EXPECT_TRUE(result.report.certify.passed());
    EXPECT_NEAR(result.report.output_volume, area_of_cup(), 1e-6);
    EXPECT_GT(result.report.lost_area, 0);
  }
}

}  // namespace
}  // namespace meshrepair::internal
