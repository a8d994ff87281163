#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include <extract/check_surface.h>
#include <extract/mesh_distance.h>
#include <repair/repair.h>

#include "shapes.h"

namespace meshrepair {
namespace {

using namespace testing;

// Less than four steps of single precision between 1 and 2.
constexpr double kSlit = 0x1p-22;

RepairResult repaired(const TriangleSoup& soup, Precision precision) {
  RepairOptions options;
  options.certify.precision = precision;
  return repair(soup, options);
}

TriangleSoup together(TriangleSoup soup, const TriangleSoup& other) {
  append(soup, other);
  return soup;
}

const TriangleSoup lid = box({0.25, 0.25, 1 + kSlit}, {0.75, 0.75, 2});
const TriangleSoup plate = box({-0.5, -0.5, 0.5}, {1.5, 1.5, 0.5 + kSlit});

TEST(ThinCells, SlitsAreFilledWhereTheirSheetsAreCut) {
  const TriangleSoup slit = flipped(box({0.25, 0.25, 0.5}, {0.75, 0.75, 0.5 + kSlit}));
  const TriangleSoup post = box({0.7, 0.7, 0.2}, {0.9, 0.9, 1.8});
  const TriangleSoup soup = together(together(cube(), slit), post);
  const RepairResult in_double = repaired(soup, Precision::float64);
  const RepairResult in_single = repaired(soup, Precision::float32);
  EXPECT_EQ(in_double.report.thin_cells.filled, 0u);
  EXPECT_GT(in_single.report.thin_cells.filled, 0u);
  EXPECT_EQ(in_single.report.thin_cells.emptied, 0u);
  EXPECT_NEAR(in_double.report.output_area - in_single.report.output_area,
              2 * (0.5 * 0.5 - 0.05 * 0.05), 1e-5);
  EXPECT_NEAR(in_single.report.slits_area, 2 * (0.5 * 0.5 - 0.05 * 0.05), 1e-5);
  EXPECT_EQ(in_single.report.fins_area, 0);
  EXPECT_NEAR(in_double.report.output_volume, in_single.report.output_volume, 1e-6);
  EXPECT_TRUE(in_single.report.certify.passed());
  EXPECT_TRUE(check_surface(in_single.surface.mesh).valid_solid());
}

TEST(ThinCells, WhatNothingCutsStays) {
  const RepairResult result = repaired(together(cube(), lid), Precision::float32);
  EXPECT_EQ(result.report.thin_cells.filled, 0u);
  EXPECT_EQ(result.report.triangles.untouched, 24u);
  EXPECT_EQ(result.report.output.parts, 2u);
}

TEST(ThinCells, FinsAreDroppedWhereTheirSheetsAreCut) {
  const TriangleSoup soup = together(cube(), plate);
  EXPECT_NEAR(repaired(soup, Precision::float64).report.output_area, 6 + 2 * 3, 1e-5);
  const RepairResult result = repaired(soup, Precision::float32);
  EXPECT_EQ(result.report.thin_cells.filled, 0u);
  EXPECT_GT(result.report.thin_cells.emptied, 0u);
  EXPECT_NEAR(result.report.fins_area, 2 * 3, 1e-5);
  EXPECT_EQ(result.report.slits_area, 0);
  EXPECT_NEAR(result.report.output_area, 6, 1e-9);
  EXPECT_NEAR(result.report.output_volume, 1, 1e-9);
}

TEST(ThinCells, WhatIsNothingButThinStays) {
  const TriangleSoup wall = box({0.5, -0.5, -0.5}, {0.5 + kSlit, 1.5, 1.5});
  const RepairResult result = repaired(together(plate, wall), Precision::float32);
  EXPECT_EQ(result.report.thin_cells.emptied, 0u);
  EXPECT_EQ(result.report.fins_area, 0);
  EXPECT_NEAR(result.report.output_area, 4 * 4, 1e-4);
}

TEST(ThinCells, TheVolumeChangesByAFewStepsOfTheNumbers) {
  std::size_t changed = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    TriangleSoup soup = moved(random_cubes(12, seed), {3000, 0, 0});
    // Copies a little beside, so that sheets lie at small distances.
    append(soup, moved(soup, {1e-4, 2e-4, 1e-4}));
    const RepairReport in_double = repaired(soup, Precision::float64).report;
    const RepairResult in_single = repaired(soup, Precision::float32);
    changed += in_single.report.thin_cells.filled + in_single.report.thin_cells.emptied;
    const double step = 3000 * 0x1p-23;
    EXPECT_LT(std::abs(in_double.output_volume - in_single.report.output_volume),
              4 * step * in_double.output_area)
        << seed;
    EXPECT_TRUE(in_single.report.certify.passed()) << seed;
    EXPECT_TRUE(check_surface(in_single.surface.mesh).valid_solid()) << seed;
  }
  EXPECT_GT(changed, 0u);
}

}  // namespace
}  // namespace meshrepair
