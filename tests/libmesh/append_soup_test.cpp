// SPDX-License-Identifier: MIT
// Soups behind each other, and in other units.
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include <mesh/append_soup.h>
#include <mesh/length_unit.h>

namespace meshrepair {
namespace {

TriangleSoup corner() { return {{{-0.0, 0, 0}, {1, 0, 0}, {0, 2, 0}}, {{0, 1, 2}}}; }

TEST(AppendSoup, StaysAsItIsWhereNothingMovesIt) {
  TriangleSoup all = corner();
  append_soup(all, corner());
  ASSERT_EQ(all.points.size(), 6u);
  EXPECT_TRUE(std::signbit(all.points[3].x()));
  EXPECT_EQ(all.triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {3, 4, 5}}));
}

TEST(AppendSoup, KeepsTheOutsideOutsideInAMirror) {
  TriangleSoup all = corner();
  Placement placement;
  placement.linear(0, 0) = -1;
  placement.offset = Vec3d(5, 0, 0);
  append_soup(all, corner(), placement);
  EXPECT_EQ(all.points[4], Vec3d(4, 0, 0));
  EXPECT_EQ(all.triangles[1], (std::array<std::uint32_t, 3>{3, 5, 4}));
}

TEST(BringToUnit, ScalesAllPoints) {
  TriangleSoup soup = corner();
  bring_to_unit(LengthUnit::inch, LengthUnit::millimeter, soup);
  EXPECT_EQ(soup.points[2], Vec3d(0, 50.8, 0));
  EXPECT_EQ(unit_scale(LengthUnit::meter, LengthUnit::millimeter), 1000);
}

TEST(BringToUnit, SameUnitLeavesPointsBitForBit) {
  TriangleSoup soup = corner();
  bring_to_unit(LengthUnit::inch, LengthUnit::inch, soup);
  EXPECT_TRUE(std::signbit(soup.points[0].x()));
  EXPECT_EQ(soup.points[2], corner().points[2]);
}

}  // namespace
}  // namespace meshrepair
