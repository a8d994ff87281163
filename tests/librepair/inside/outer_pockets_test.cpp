// SPDX-License-Identifier: MIT
#include <vector>

#include <gtest/gtest.h>

#include <repair/repair.h>

#include "shapes.h"

namespace meshrepair {
namespace {

using namespace testing;

// Outline times [0, height], bottom and top as fans around a point: closed and oriented, also where
// the outline crosses itself.
TriangleSoup prism(const std::vector<Vec3d>& outline, const Vec3d& centre, double height) {
  TriangleSoup soup;
  const auto n = static_cast<std::uint32_t>(outline.size());
  const Vec3d up(0, 0, height);
  for (const Vec3d& p : outline) soup.points.push_back(p);
  for (const Vec3d& p : outline) soup.points.push_back(p + up);
  soup.points.push_back(centre);
  soup.points.push_back(centre + up);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    soup.triangles.push_back({i, j, j + n});
    soup.triangles.push_back({i, j + n, i + n});
    soup.triangles.push_back({2 * n, j, i});
    soup.triangles.push_back({2 * n + 1, i + n, j + n});
  }
  return soup;
}

// A block of 10 x 10 x 5 at whose side y = 10 the outline makes a turn the wrong way, `width` wide
// and `thick` thick.
TriangleSoup folded_block(double width, double thick) {
  const double end = 4 + width;
  return prism({{0, 0, 0},
                {10, 0, 0},
                {10, 10, 0},
                {4, 10, 0},
                {4, 10 + thick, 0},
                {end, 10 + thick, 0},
                {end, 9.99, 0},
                {0, 9.99, 0}},
               {5, 5, 0}, 5);
}

RepairReport report_of(const TriangleSoup& soup) { return repair(soup, RepairOptions{}).report; }

TEST(OuterPockets, AThinFoldIsLeftOut) {
  const RepairReport report = report_of(folded_block(0.2, 0.004));
  EXPECT_EQ(report.inside.used, InsideRule::winding);
  EXPECT_EQ(report.inside.left_out_folds, 1u);
  EXPECT_EQ(report.output.parts, 1u);
  EXPECT_NEAR(report.output_volume, 500, 0.5);
}

TEST(OuterPockets, WhatIsNoSliverIsSolid) {
  const RepairReport report = report_of(folded_block(0.2, 0.2));
  EXPECT_EQ(report.inside.left_out_folds, 0u);
  const double without = report_of(folded_block(0.2, 0.004)).output_volume;
  EXPECT_NEAR(report.output_volume - without, 0.2 * 0.2 * 5, 1e-4);
}

TEST(OuterPockets, ALargeSliverIsSolid) {
  const RepairReport report = report_of(folded_block(5, 0.01));
  EXPECT_EQ(report.inside.left_out_folds, 0u);
  EXPECT_EQ(report.output.parts, 2u);
}

TEST(OuterPockets, ManyFoldsArePartOfTheThing) {
  std::vector<Vec3d> outline = {{0, 0, 0}, {10, 0, 0}, {10, 10, 0}};
  for (int i = 0; i < 15; ++i) {
    const double from = 9.3 - 0.6 * i, to = from + 0.2;
    for (const Vec3d& p :
         {Vec3d(from, 10, 0), Vec3d(from, 10.004, 0), Vec3d(to, 10.004, 0), Vec3d(to, 9.99, 0),
          Vec3d(from - 0.1, 9.99, 0), Vec3d(from - 0.1, 10, 0)}) {
      outline.push_back(p);
    }
  }
  outline.emplace_back(0, 10, 0);
  const RepairReport report = report_of(prism(outline, {5, 5, 0}, 5));
  EXPECT_EQ(report.inside.left_out_folds, 0u);
  EXPECT_EQ(report.output.parts, 16u);
}

// A thin tray, open and inside out, is nothing but a pocket of a patch: it is a part of its own.
TEST(OuterPockets, AThinPartOfItsOwnThatIsInsideOutIsNoFold) {
  TriangleSoup soup = box({0, 0, 0}, {100, 100, 100});
  TriangleSoup tray = box({200, 0, 0}, {201, 1, 0.004});
  tray.triangles.erase(tray.triangles.begin(), tray.triangles.begin() + 2);
  append(soup, flipped(tray));
  const RepairReport report = report_of(soup);
  EXPECT_EQ(report.inside.left_out_folds, 0u);
  EXPECT_EQ(report.output.parts, 2u);
}

}  // namespace
}  // namespace meshrepair
