// SPDX-License-Identifier: MIT
// The triangles of a terrain stay as they are on walls and a floor.

#include <cmath>

#include <gtest/gtest.h>

#include <base/error.h>
#include <repair/explain_repair.h>
#include <repair/repair_on_base.h>

#include "open_surfaces.h"
#include "shapes.h"
#include "triangles_by_place.h"

namespace meshrepair {
namespace {

using namespace testing;

// As STL has it: no corner belongs to two triangles.
TriangleSoup unwelded(const TriangleSoup& soup) {
  TriangleSoup apart;
  for (const auto& t : soup.triangles) {
    const auto base = static_cast<std::uint32_t>(apart.points.size());
    for (const std::uint32_t p : t) apart.points.push_back(soup.points[p]);
    apart.triangles.push_back({base, base + 1, base + 2});
  }
  return apart;
}

TEST(RepairOnBase, KeepsAllTriangles) {
  for (const TriangleSoup& terrain : {wavy_sheet(9), unwelded(wavy_sheet(9))}) {
    ScanBaseOptions base;
    base.floor = -2;
    ScanBaseReport stands;
    RepairReport report;
    const Surface solid = repair_on_base(terrain, base, {}, stands, report);
    EXPECT_TRUE(report.certify.passed());
    EXPECT_EQ(report.triangles.untouched, terrain.triangles.size());
    TriangleSoup given;
    given.points = solid.mesh.points;
    for (std::size_t t = 0; t < solid.source.size(); ++t) {
      if (solid.source[t] == Surface::kNoSource) continue;
      EXPECT_LT(solid.source[t], terrain.triangles.size());
      given.triangles.push_back(solid.mesh.triangles[t]);
    }
    EXPECT_EQ(triangles_by_place(given), triangles_by_place(terrain));
    EXPECT_EQ(stands.floor, -2);
    // The hills average to nothing.
    EXPECT_NEAR(report.output_volume, 16 * 2, 1);
  }
}

// A ring from a hole to the floor would be a funnel.
TEST(RepairOnBase, AHoleIsNoWayToTheFloor) {
  TriangleSoup terrain = wavy_sheet(9);
  const std::size_t middle = terrain.triangles.size() / 2;
  terrain.triangles.erase(terrain.triangles.begin() + static_cast<std::ptrdiff_t>(middle));
  ScanBaseOptions base;
  base.floor = -0.6;
  ScanBaseReport stands;
  RepairReport report;
  (void)repair_on_base(terrain, base, {}, stands, report);
  EXPECT_EQ(report.holes.rings, 0u);
  EXPECT_NEAR(report.output_volume, 16 * 0.6, 1);
}

TEST(RepairOnBase, CopiesOfATriangleAreOne) {
  const TriangleSoup once = wavy_sheet(9);
  TriangleSoup twice = once;
  for (const auto& [a, b, c] : once.triangles) twice.triangles.push_back({c, b, a});
  twice.triangles.push_back({0, 0, 1});
  ScanBaseReport stands;
  RepairReport report, report_of_copies;
  RepairOptions options;
  options.explain = true;
  const Surface solid = repair_on_base(once, {}, {}, stands, report);
  const Surface of_copies = repair_on_base(twice, {}, options, stands, report_of_copies);
  EXPECT_EQ(of_copies.mesh.triangles, solid.mesh.triangles);
  EXPECT_EQ(report_of_copies.clean.duplicates, once.triangles.size());
  const RepairExplanation& explanation = report_of_copies.explanation;
  EXPECT_EQ(explanation.fates.size(), twice.triangles.size());
  for (std::size_t t = 0; t < solid.source.size(); ++t) {
    const bool is_made_up = of_copies.source[t] == Surface::kNoSource;
    EXPECT_EQ(explanation.origins[t] == TriangleOrigin::patch, is_made_up);
  }
}

TEST(RepairOnBase, SolidsGetNoBase) {
  ScanBaseReport stands;
  RepairReport report;
  EXPECT_THROW((void)repair_on_base(cube(), {}, {}, stands, report), NoSolidError);
}

}  // namespace
}  // namespace meshrepair
