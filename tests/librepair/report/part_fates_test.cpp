// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <repair/repair.h>

#include "shapes.h"

namespace meshrepair {
namespace {

using namespace testing;

TEST(PartFates, NothingIsRemovedFromASolid) {
  const RepairReport report = repair(cube()).report;
  EXPECT_EQ(report.parts.enclosing_nothing.parts, 0u);
  EXPECT_EQ(report.parts.inside_solid.parts, 0u);
  EXPECT_EQ(report.triangles.untouched, 12u);
  EXPECT_EQ(report.triangles.cut, 0u);
}

TEST(PartFates, SheetsAndHiddenPartsAreToldApart) {
  TriangleSoup soup = cube();
  append(soup, moved(scaled(cube(), 0.25), {0.25, 0.25, 0.25}));
  TriangleSoup triangle;
  triangle.points = {{2, 0, 0}, {3, 0, 0}, {2, 1, 0}};
  triangle.triangles = {{0, 1, 2}};
  append(soup, triangle);
  append(soup, moved(triangle, {1, 5, 5}));
  const RepairReport report = repair(soup).report;
  EXPECT_EQ(report.parts.inside_solid.parts, 1u);
  EXPECT_EQ(report.parts.closed_inside, 1u);
  EXPECT_DOUBLE_EQ(report.parts.inside_solid.area, 6.0 / 16);
  EXPECT_EQ(report.parts.enclosing_nothing.parts, 2u);
  EXPECT_DOUBLE_EQ(report.parts.enclosing_nothing.area, 1);
  EXPECT_EQ(report.triangles.untouched, 12u);
  EXPECT_EQ(report.triangles.cut, 0u);
  EXPECT_EQ(report.parts.inside_triangles, 12u);
  EXPECT_EQ(report.parts.outside_triangles, 2u);
}

TEST(PartFates, CutTrianglesAreCounted) {
  TriangleSoup soup = cube();
  append(soup, moved(scaled(cube(), 0.5), {0.75, 0.25, 0.25}));
  const RepairReport report = repair(soup).report;
  EXPECT_EQ(report.parts.inside_solid.parts, 0u);
  // The small cube's face inside the large one is gone; its four sides and what they pass are cut.
  EXPECT_EQ(report.triangles.untouched + report.triangles.cut + 2u, 24u);
  EXPECT_GE(report.triangles.cut, 8u);
}

}  // namespace
}  // namespace meshrepair
