// SPDX-License-Identifier: MIT
// What a result has in common with what was given.
#include <utility>

#include <gtest/gtest.h>

#include <repair/repair.h>

#include "shapes.h"

namespace meshrepair {
namespace {

using namespace testing;

RepairReport report_of(const TriangleSoup& soup, Precision precision, bool all_cells) {
  RepairOptions options;
  options.certify.precision = precision;
  options.all_cells = all_cells;
  RepairReport report;
  (void)repair(soup, options, report);
  return report;
}

// No single-precision number is a third.
TriangleSoup thirds() { return moved(scaled(cube(), 1.0 / 3), {1.0 / 3, 1.0 / 3, 1.0 / 3}); }

TEST(DescribeResult, RoundedTrianglesAreWholeAllTheSame) {
  for (const bool all_cells : {false, true}) {
    const RepairReport report = report_of(thirds(), Precision::float32, all_cells);
    EXPECT_EQ(report.triangles.untouched, 0U);
    EXPECT_EQ(report.triangles.cut, 12U);
    EXPECT_EQ(report.triangles.rounded, 12U);
    EXPECT_TRUE(report.same_triangles);
  }
}

TEST(DescribeResult, NothingIsRoundedInDoublePrecision) {
  const RepairReport report = report_of(thirds(), Precision::float64, false);
  EXPECT_EQ(report.triangles.untouched, 12U);
  EXPECT_EQ(report.triangles.rounded, 0U);
  EXPECT_TRUE(report.same_triangles);
}

TEST(DescribeResult, CutTrianglesAreNotRounded) {
  TriangleSoup soup = thirds();
  append(soup, moved(thirds(), {0.1, 0.1, 0.1}));
  const RepairReport report = report_of(soup, Precision::float32, false);
  EXPECT_GT(report.triangles.rounded, 0U);
  EXPECT_LT(report.triangles.rounded, report.triangles.cut);
  EXPECT_FALSE(report.same_triangles);
}

TEST(DescribeResult, TurnedAndAddedTrianglesAreOthers) {
  TriangleSoup turned = cube();
  std::swap(turned.triangles[0][0], turned.triangles[0][1]);
  EXPECT_FALSE(report_of(turned, Precision::float64, true).same_triangles);
  TriangleSoup open = cube();
  open.triangles.pop_back();
  EXPECT_FALSE(report_of(open, Precision::float64, true).same_triangles);
}

}  // namespace
}  // namespace meshrepair
