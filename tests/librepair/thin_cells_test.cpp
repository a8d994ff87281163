#include <algorithm>
#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include <extract/check_surface.h>
#include <extract/mesh_distance.h>
#include <repair/repair.h>

#include "complexes.h"
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

TEST(ThinCells, FixedCellsStay) {
  const TriangleSoup post = box({0.7, 0.7, 0.2}, {0.9, 0.9, 1.8});
  Cells cells = cells_of(together(together(cube(), lid), post));
  const auto cover = cover_of(cells);
  const double within = 2 * kSlit / cells.complex.soup().grid.unit;
  std::vector<char> solid = enclosed_cells(cells.complex, cover);
  const std::vector<char> before = solid;
  const std::vector<CellState> fixed(solid.size(), CellState::fixed);
  EXPECT_EQ(relabel_thin_cells(cells.complex, cover, within, solid, nullptr, fixed).filled, 0u);
  EXPECT_EQ(solid, before);
  EXPECT_GT(relabel_thin_cells(cells.complex, cover, within, solid).filled, 0u);
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

// A ball, and three copies with points that are off by less than a step of single precision.
TriangleSoup nearly_equal_balls(std::uint64_t seed) {
  Random random(seed);
  const TriangleSoup ball = noisy_sphere(150, 0.2, seed);
  TriangleSoup soup = ball;
  constexpr double kOff = 1e-7;
  for (int i = 0; i < 3; ++i) {
    TriangleSoup copy = ball;
    for (Vec3d& p : copy.points) {
      p += Vec3d(random.real(-kOff, kOff), random.real(-kOff, kOff), random.real(-kOff, kOff));
    }
    append(soup, copy);
  }
  return soup;
}

std::size_t attempts(const RepairReport& report) {
  return static_cast<std::size_t>(
      std::count_if(report.stages.begin(), report.stages.end(),
                    [](const StageReport& stage) { return stage.name == "extract"; }));
}

TEST(ThinCells, SlitsAreWidenedWhereFewFaultsAreLeft) {
  RepairOptions options;
  options.certify.precision = Precision::float32;
  options.certify.most_rounds = 1;
  options.slit_steps = 0.25;
  const TriangleSoup soup = nearly_equal_balls(5);
  const RepairResult result = repair(soup, options);
  EXPECT_GT(attempts(result.report), 1u);
  EXPECT_LE(attempts(result.report), 3u);
  EXPECT_TRUE(result.report.certify.passed());
  EXPECT_TRUE(check_surface(result.surface.mesh).valid_solid());
  const RepairReport in_double = repaired(soup, Precision::float64).report;
  EXPECT_LT(std::abs(in_double.output_volume - result.report.output_volume),
            16 * options.slit_steps * 0x1p-23 * in_double.output_area);
}

TEST(ThinCells, SlitsCanBeLeftAlone) {
  RepairOptions options;
  options.certify.precision = Precision::float32;
  options.certify.most_rounds = 0;
  options.slit_steps = 0;
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const RepairReport report = repair(nearly_equal_balls(seed), options).report;
    EXPECT_EQ(report.thin_cells.filled + report.thin_cells.emptied, 0u);
    EXPECT_EQ(attempts(report), 1u);
  }
}

}  // namespace
}  // namespace meshrepair
