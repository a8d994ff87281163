// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include <check/check_surface.h>
#include <check/mesh_distance.h>
#include <repair/repair.h>

#include "each_seed.h"
#include "shapes.h"
#include "share_of_cases.h"

namespace meshrepair {
namespace {

using namespace testing;

// Less than four steps of single precision between 1 and 2, and four of the working grid.
constexpr double kSlit = 0x1p-22;

RepairResult repaired(const TriangleSoup& soup, Precision precision) {
  RepairOptions options;
  options.certify.precision = precision;
  options.all_cells = true;
  return repair(soup, options);
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
  for (std::uint64_t seed = 0; seed < share_of_cases(20u); ++seed) {
    TriangleSoup soup = moved(random_cubes(12, seed), {3000, 0, 0});
    // Copies a little beside, so that sheets lie at small distances.
    append(soup, moved(soup, {1e-4, 2e-4, 1e-4}));
    const RepairReport in_double = repaired(soup, Precision::float64).report;
    const RepairResult in_single = repaired(soup, Precision::float32);
    changed += in_single.report.thin_cells.filled + in_single.report.thin_cells.emptied;
    const double step = 3000 * 0x1p-23;
    EXPECT_LT(std::abs(in_double.output_volume - in_single.report.output_volume),
              2 * 4 * step * in_double.output_area)
        << seed;
    EXPECT_TRUE(in_single.report.certify.passed()) << seed;
    EXPECT_TRUE(check_surface(in_single.surface.mesh).valid_solid()) << seed;
  }
  EXPECT_GE(changed, expected_cases(1u));
}

// A ball, and three copies with points that are off by about a step of single precision, which is
// some of the working grid.
TriangleSoup nearly_equal_balls(std::uint64_t seed) {
  Random random(seed);
  const TriangleSoup ball = moved(noisy_sphere(150, 0.2, seed), {8, 0, 0});
  TriangleSoup soup = ball;
  constexpr double kOff = 0x1p-20;
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

// Which faults are left is a matter of last bits.
TEST(ThinCells, SlitsAreWidenedWhereFewFaultsAreLeft) {
  RepairOptions options;
  options.certify.precision = Precision::float32;
  options.certify.most_rounds = 1;
  options.slit_steps = 0.125;
  std::size_t widened = 0;
  for (std::uint64_t seed = 0; seed < 4 && widened == 0; ++seed) {
    const TriangleSoup soup = nearly_equal_balls(seed);
    const RepairResult result = repair(soup, options);
    widened += attempts(result.report) > 1 ? 1 : 0;
    EXPECT_LE(attempts(result.report), 3u);
    EXPECT_TRUE(result.report.certify.passed());
    EXPECT_TRUE(check_surface(result.surface.mesh).valid_solid());
    const RepairReport in_double = repaired(soup, Precision::float64).report;
    EXPECT_LT(std::abs(in_double.output_volume - result.report.output_volume),
              2 * 16 * options.slit_steps * 0x1p-20 * in_double.output_area);
  }
  EXPECT_GT(widened, 0u);
}

TEST(ThinCells, SlitsCanBeLeftAlone) {
  RepairOptions options;
  options.certify.precision = Precision::float32;
  options.certify.most_rounds = 0;
  options.slit_steps = 0;
  options.simplify = 0;  // an attempt of its own where it has to go
  options.all_cells = true;
  for_each_seed(3, [&](std::uint64_t seed) {
    const RepairReport report = repair(nearly_equal_balls(seed), options).report;
    EXPECT_EQ(report.thin_cells.filled + report.thin_cells.emptied, 0u);
    EXPECT_EQ(attempts(report), 1u);
  });
}

// The same solid several times, as it comes out of being turned and turned back: its points are off
// by less than a step of the working grid, which then puts them on one side or the other.
TriangleSoup nearly_equal_copies(const TriangleSoup& solid, int copies, double off,
                                 Random& random) {
  TriangleSoup soup = solid;
  for (int i = 1; i < copies; ++i) {
    TriangleSoup copy = solid;
    for (Vec3d& p : copy.points) {
      p += Vec3d(random.real(-off, off), random.real(-off, off), random.real(-off, off));
    }
    append(soup, copy);
  }
  return soup;
}

TriangleSoup turned_box(Random& random) {
  return transformed(box({-1, -0.5, -0.25}, {1, 0.5, 0.25}), random_rotation(random));
}

RepairResult repaired_without(const TriangleSoup& soup) {
  RepairOptions options;
  options.slit_steps = 0;
  options.all_cells = true;
  return repair(soup, options);
}

// There is nothing between these to be filled, and edges are not to be cut off.
TEST(ThinCells, FacesThatNearlyCoincideBecomeOne) {
  for_each_seed(20, [&](std::uint64_t seed) {
    Random random(seed);
    const TriangleSoup soup = nearly_equal_copies(turned_box(random), 5, 0x1p-25, random);
    const RepairResult result = repaired(soup, Precision::float64);
    EXPECT_TRUE(result.report.certify.passed());
    EXPECT_TRUE(check_surface(result.surface.mesh).valid_solid());
    EXPECT_LT(result.report.thin_cells.emptied, 20u);
    EXPECT_NEAR(result.report.output_volume, 1, 1e-6);
    EXPECT_NEAR(result.report.output_area, 7, 1e-5);
  });
}

// No cell of the stacks between these would be better off alone on the other side.
// Two halves of a box, each several times, and a bar through the slits between them.
// Few are wider than two steps of the grid, or have a side that nothing cuts.
TEST(ThinCells, StacksOfSlitsAreFilledInDoublePrecisionToo) {
  double area = 0, area_without = 0;
  std::size_t triangles = 0, without = 0;
  for (std::uint64_t seed = 0; seed < share_of_cases(20u); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Eigen::Matrix3d turn = random_rotation(random);
    constexpr double kGap = 0x1p-26;
    const auto part = [&](const Vec3d& low, const Vec3d& high, int copies) {
      return nearly_equal_copies(transformed(box(low, high), turn), copies, 0x1p-26, random);
    };
    TriangleSoup soup = part({-1, -0.5, -0.25}, {0, 0.5, 0.25}, 3);
    append(soup, part({kGap, -0.5, -0.25}, {1, 0.5, 0.25}, 3));
    append(soup, part({-0.5, -0.1, -0.1}, {0.5, 0.1, 0.1}, 1));
    const RepairResult result = repaired(soup, Precision::float64);
    EXPECT_TRUE(result.report.certify.passed());
    EXPECT_TRUE(check_surface(result.surface.mesh).valid_solid());
    EXPECT_NEAR(result.report.output_volume, 1, 1e-6);
    const RepairResult left = repaired_without(soup);
    area += result.report.output_area - 7;
    area_without += left.report.output_area - 7;
    triangles += result.surface.mesh.triangles.size();
    without += left.surface.mesh.triangles.size();
  }
  EXPECT_LT(area, area_without / 4);
  EXPECT_LT(triangles, without);
}

// In steps of the grid that the soup's points were put on.
TEST(ThinCells, WhatNearlyCoincidesStaysAValidSolidOfItsVolume) {
  std::size_t changed = 0;
  for (std::uint64_t seed = 0; seed < share_of_cases(12u); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    TriangleSoup solid = seed % 2 == 0 ? turned_box(random) : noisy_sphere(100, 0.2, seed);
    append(solid, moved(turned_box(random), {0.3, 0.2, 0.1}));
    const double off = std::ldexp(1.0, -26 + random.integer(0, 4));
    const TriangleSoup soup = nearly_equal_copies(solid, random.integer(2, 4), off, random);
    for (const Precision precision : {Precision::float64, Precision::float32}) {
      const RepairResult result = repaired(soup, precision);
      changed += result.report.thin_cells.filled + result.report.thin_cells.emptied;
      EXPECT_TRUE(result.report.certify.passed());
      EXPECT_TRUE(check_surface(result.surface.mesh).valid_solid());
      if (precision == Precision::float32) continue;
      const RepairReport without = repaired_without(soup).report;
      constexpr double kReach = 2 * 2;
      EXPECT_LT(std::abs(result.report.output_volume - without.output_volume),
                kReach * without.clean.grid_unit * without.output_area);
      EXPECT_LE(result.report.output_area, without.output_area * (1 + 1e-6));
    }
  }
  EXPECT_GT(changed, 0u);
}

}  // namespace
}  // namespace meshrepair
