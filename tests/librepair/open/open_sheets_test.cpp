// SPDX-License-Identifier: MIT
// Open sheets that are flat but for rounding, or hardly bent, enclose nothing, however they are
// turned.

#include "open/open_sheets.h"

#include <cstdint>
#include <utility>

#include <gtest/gtest.h>

#include <check/check_surface.h>
#include <mesh/precision.h>
#include <repair/repair.h>

#include "each_seed.h"
#include "open/open_sheets.h"
#include "open_surfaces.h"
#include "shapes.h"
#include "share_of_cases.h"
#include "triangles_by_place.h"

namespace meshrepair {
namespace {

using namespace testing;

TriangleSoup flat_sheet(std::uint32_t n) {
  TriangleSoup sheet = wavy_sheet(n);
  for (Vec3d& p : sheet.points) p.z() = 0;
  return sheet;
}

TriangleSoup in_single_precision(TriangleSoup soup) {
  for (Vec3d& p : soup.points) p = internal::rounded_to(p, Precision::float32);
  return soup;
}

TEST(OpenRegions, RegionsOfAFlatSheetAreEmpty) {
  for_each_seed(30, [&](std::uint64_t seed) {
    for (const std::uint32_t n : {1u, 2u, 9u}) {
      const TriangleSoup sheet = placed(flat_sheet(n), seed);
      EXPECT_THROW((void)repair(sheet), NoSolidError) << seed;
      EXPECT_THROW((void)repair(in_single_precision(sheet)), NoSolidError) << seed;
    }
  });
}

TEST(OpenRegions, RegionsOfSeveralFlatSheetsAreEmpty) {
  for_each_seed(20, [&](std::uint64_t seed) {
    TriangleSoup sheets = flat_sheet(6);
    append(sheets, moved(transformed(flat_sheet(5), Eigen::AngleAxisd(1, Vec3d::UnitX()).matrix()),
                         {5, 0, 0}));
    EXPECT_THROW((void)repair(placed(sheets, seed)), NoSolidError) << seed;
  });
}

TEST(OpenRegions, RegionsOfHardlyBentSheetsAreEmpty) {
  for (std::uint64_t seed = 0; seed < share_of_cases(10u); ++seed) {
    for (const double height : {1e-6, 1e-3, 0.05}) {
      Random random(seed);
      TriangleSoup sheet = flat_sheet(16);
      for (Vec3d& p : sheet.points) p.z() = random.real(0, height);
      EXPECT_THROW((void)repair(placed(sheet, seed)), NoSolidError) << seed << ' ' << height;
    }
  }
}

TEST(OpenRegions, BesideASolidLeaveItAsItIs) {
  for_each_seed(20, [&](std::uint64_t seed) {
    const TriangleSoup solid = placed(box({1, 1, 1}, {2, 3, 2}), seed);
    TriangleSoup scene = solid;
    append(scene, placed(flat_sheet(8), seed));
    const RepairResult result = repair(scene);
    EXPECT_EQ(triangles_by_place(result.surface.mesh), triangles_by_place(solid)) << seed;
    EXPECT_EQ(result.report.parts.enclosing_nothing.parts, 1u) << seed;
  });
}

// A ground under a box that stands on it, or through which it runs, is no part of the box. Where
// the planes of its triangles cross by chance, something of it may be thicker than rounding, and
// stay.
TEST(OpenRegions, LeaveNoFinsOnASolid) {
  int spoilt = 0;
  for_each_seed(10, [&](std::uint64_t seed) {
    for (const double height : {0.0, 0.3}) {
      TriangleSoup scene = box({1, 1, -height}, {2, 3, 1 - height});
      append(scene, flat_sheet(8));
      const RepairReport report = repair(placed(scene, seed)).report;
      EXPECT_NEAR(report.output_volume, 2, 0.02) << seed;
      spoilt += report.output_volume > 2.000001 || report.output_area > 10.001 ? 1 : 0;
    }
  });
  EXPECT_LT(spoilt, 7);
}

TEST(OpenRegions, RegionsOfCrossingFlatSheetsAreEmpty) {
  TriangleSoup cross = flat_sheet(8);
  TriangleSoup upright = flat_sheet(8);
  for (Vec3d& p : upright.points) p = Vec3d(2, p.y(), p.x() - 2);
  append(cross, upright);
  int empty = 0;
  for_each_seed(10, [&](std::uint64_t seed) {
    try {
      EXPECT_LT(repair(placed(cross, seed)).report.output_volume, 0.02) << seed;
    } catch (const NoSolidError&) {
      ++empty;
    }
  });
  EXPECT_GT(empty, expected_cases(6));
}

// Crumbs of a sheet are none of it: what its folds enclose is not what was meant.
TEST(OpenRegions, RegionsThatSheetsHardlyBoundAreEmpty) {
  for_each_seed(10, [&](std::uint64_t seed) {
    TriangleSoup terrain = wavy_sheet(24);
    // Folds: one line of points lies beyond the next one, and above it.
    Random random(seed);
    const auto row = static_cast<std::uint32_t>(random.integer(5, 18));
    for (std::uint32_t j = 8; j < 16; ++j) {
      terrain.points[row * 25 + j] += Vec3d(random.real(0.2, 0.3), 0, random.real(0.05, 0.15));
    }
    EXPECT_THROW((void)repair(placed(terrain, seed)), NoSolidError);
  });
}

// A unit cube of six walls that run beyond each other.
TriangleSoup box_of_walls(double beyond) {
  TriangleSoup walls;
  const double low = -beyond, high = 1 + beyond;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double at : {0.0, 1.0}) {
      TriangleSoup wall;
      for (const auto& [u, v] : {std::pair{low, low}, {high, low}, {high, high}, {low, high}}) {
        Vec3d p;
        p[axis] = at;
        p[(axis + 1) % 3] = u;
        p[(axis + 2) % 3] = v;
        wall.points.push_back(p);
      }
      wall.triangles = {{0, 1, 2}, {0, 2, 3}};
      append(walls, at > 0 ? wall : flipped(wall));
    }
  }
  return walls;
}

// Each is flat; what they enclose together is not.
TEST(OpenRegions, RegionsThatSheetsEncloseTogetherAreSolid) {
  for_each_seed(10, [&](std::uint64_t seed) {
    const RepairResult result = repair(placed(box_of_walls(0.1), seed));
    EXPECT_NEAR(result.report.output_volume, 1, 0.02) << seed;
    EXPECT_TRUE(check_surface(result.surface.mesh).valid_solid()) << seed;
  });
}

// What is solid outside of the walls is open, and goes by itself.
TEST(OpenRegions, TakeNothingAlongThatIsWalledIn) {
  TriangleSoup scene = box_of_walls(0.3);
  TriangleSoup beside = flat_sheet(1);
  for (Vec3d& p : beside.points) p = Vec3d(1.7, 1.5 * p.x() - 2.5, 1.5 * p.y() - 2.5);
  append(scene, beside);
  EXPECT_NEAR(repair(scene).report.output_volume, 1, 1e-6);
}

TEST(FlatSheets, HaveNoClosedPartBesideThem) {
  TriangleSoup scene = flat_sheet(1);
  append(scene, box({1, 1, 0}, {3, 3, 0x1p-22}));
  EXPECT_NEAR(repair(scene).report.output_volume, 0x1p-20, 1e-12);
}

bool is_flat(const TriangleSoup& soup) {
  CleanReport report;
  return internal::is_flat_sheet(clean_soup(soup, report));
}

TEST(FlatSheets, AreToldFromThinSolidsAndFromWavyOnes) {
  EXPECT_TRUE(is_flat(flat_sheet(4)));
  EXPECT_FALSE(is_flat(wavy_sheet(4)));
  TriangleSoup open = box({0, 0, 0}, {1, 1, 0x1p-20});
  open.triangles.pop_back();
  EXPECT_FALSE(is_flat(open));
}

TEST(FlatSheets, TellTheRoundingOfTheirCoordinates) {
  CleanReport report;
  // A step of single precision below 16 is 2^-20, of the grid over 4 units 2^-23.
  const TriangleSoup far = moved(flat_sheet(3), {9.1, 9.3, 9.7});
  const CleanSoup in_double = clean_soup(far, report);
  const CleanSoup in_single = clean_soup(in_single_precision(far), report);
  EXPECT_DOUBLE_EQ(internal::rounding_of(in_single), 8 * internal::rounding_of(in_double));
}

}  // namespace
}  // namespace meshrepair
