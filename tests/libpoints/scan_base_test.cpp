// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <base/error.h>
#include <mesh/topology.h>
#include <points/scan_base.h>
#include <repair/repair.h>

#include "shapes.h"

namespace meshrepair {
namespace {

// Hills over the unit square, without the quads that `hole` says.
template <class Hole>
TriangleSoup terrain(std::uint32_t size, const Hole& hole) {
  TriangleSoup soup;
  for (std::uint32_t x = 0; x <= size; ++x) {
    for (std::uint32_t y = 0; y <= size; ++y) {
      const double u = static_cast<double>(x) / size;
      const double v = static_cast<double>(y) / size;
      soup.points.emplace_back(u, v, 0.1 * std::sin(7 * u) * std::cos(5 * v));
    }
  }
  for (std::uint32_t x = 0; x < size; ++x) {
    for (std::uint32_t y = 0; y < size; ++y) {
      if (hole(x, y)) continue;
      const std::uint32_t a = x * (size + 1) + y;
      const std::uint32_t b = a + size + 1;
      soup.triangles.push_back({a, b, b + 1});
      soup.triangles.push_back({a, b + 1, a + 1});
    }
  }
  return soup;
}

bool nowhere(std::uint32_t, std::uint32_t) { return false; }

Surface solid_on_base(const TriangleSoup& soup, RepairReport& report) {
  ScanBaseReport base;
  RepairOptions options;
  options.holes.largest_share = options.holes.largest_flat_share =
      std::numeric_limits<double>::max();
  return repair(with_base(soup, {}, base), options, report);
}

TEST(ScanBase, MakesASolidOfATerrain) {
  RepairReport report;
  (void)solid_on_base(terrain(20, nowhere), report);
  EXPECT_TRUE(report.certify.passed());
  EXPECT_EQ(report.output.parts, 1U);
  // The hills average to little; the floor is five hundredths of the diagonal below.
  EXPECT_GT(report.output_volume, 0.1);
  EXPECT_LT(report.output_volume, 0.3);
}

TEST(ScanBase, HolesInTheGroundGetNoWalls) {
  const TriangleSoup holed =
      terrain(20, [](std::uint32_t x, std::uint32_t y) { return x == 7 && y == 9; });
  ScanBaseReport base;
  const TriangleSoup soup = with_base(holed, {}, base);
  EXPECT_EQ(base.skirt_triangles, 2U * 4 * 20);
  RepairReport whole;
  RepairReport report;
  (void)solid_on_base(terrain(20, nowhere), whole);
  (void)solid_on_base(holed, report);
  EXPECT_TRUE(report.certify.passed());
  EXPECT_NEAR(report.output_volume, whole.output_volume, 1e-3);
}

TEST(ScanBase, WallsTurnAsTheGroundDoes) {
  ScanBaseReport base;
  const TriangleSoup soup = with_base(terrain(5, nowhere), {}, base);
  EXPECT_EQ(examine_topology(soup.triangles, soup.points.size()).inconsistent_edges, 0U);
}

TEST(ScanBase, StandsAlongTheAxisThatIsAskedFor) {
  TriangleSoup wall = terrain(5, nowhere);
  for (Vec3d& p : wall.points) p = {p.z(), p.x(), p.y()};
  ScanBaseOptions options;
  options.axis = 0;
  ScanBaseReport base;
  const TriangleSoup soup = with_base(wall, options, base);
  double lowest = 0;
  for (const Vec3d& p : soup.points) lowest = std::min(lowest, p.x());
  EXPECT_EQ(lowest, base.floor);
  EXPECT_LT(base.floor, -0.1);
}

TEST(ScanBase, SmallPiecesAreDropped) {
  TriangleSoup soup = terrain(20, nowhere);
  testing::append(soup, testing::moved(testing::scaled(terrain(1, nowhere), 0.01), {0, 0, 1}));
  ScanBaseReport base;
  (void)with_base(soup, {}, base);
  EXPECT_EQ(base.parts, 1U);
  EXPECT_EQ(base.dropped_triangles, 2U);
}

TEST(ScanBase, PiecesOfFewTrianglesAreDroppedHoweverLarge) {
  TriangleSoup soup = terrain(20, nowhere);
  testing::append(soup, testing::moved(terrain(1, nowhere), {0, 0, 1}));
  ScanBaseReport base;
  (void)with_base(soup, {}, base);
  EXPECT_EQ(base.parts, 1U);
  EXPECT_EQ(base.dropped_triangles, 2U);
}

// A ball with a small hole hovers over the ground: only the ground gets a wall.
TEST(ScanBase, HolesGetNoWalls) {
  TriangleSoup ball = testing::sphere(2000, 0.2);
  ball.triangles.pop_back();
  ScanBaseReport base;
  EXPECT_THROW((void)with_base(ball, {}, base), NoSolidError);
  TriangleSoup soup = terrain(20, nowhere);
  testing::append(soup, testing::moved(ball, {0.5, 0.5, 1}));
  const TriangleSoup on_base = with_base(soup, {}, base);
  EXPECT_EQ(base.parts, 1U);
  EXPECT_EQ(base.dropped_triangles, 0U);
  EXPECT_EQ(base.skirt_triangles, 4U * 20 * 2);
  EXPECT_EQ(on_base.triangles.size(), soup.triangles.size() + base.skirt_triangles);
}

TEST(ScanBase, StandsWhereItIsTold) {
  ScanBaseReport base;
  ScanBaseOptions options;
  options.depth = 3;
  options.is_share = false;
  double low = 0;
  for (const Vec3d& p : terrain(8, nowhere).points) low = std::min(low, p.z());
  (void)with_base(terrain(8, nowhere), options, base);
  EXPECT_EQ(base.floor, low - 3);
  options.floor = -0.5;
  (void)with_base(terrain(8, nowhere), options, base);
  EXPECT_EQ(base.floor, -0.5);
  options.floor = low;
  EXPECT_THROW((void)with_base(terrain(8, nowhere), options, base), UsageError);
}

TEST(ScanBase, ClosedSurfacesGetNoBase) {
  ScanBaseReport base;
  EXPECT_THROW((void)with_base(testing::cube(), {}, base), NoSolidError);
  ScanBaseOptions options;
  options.axis = 3;
  EXPECT_THROW((void)with_base(terrain(3, nowhere), options, base), UsageError);
}

}  // namespace
}  // namespace meshrepair
