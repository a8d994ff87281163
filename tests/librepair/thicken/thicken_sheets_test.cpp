// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include <base/error.h>
#include <repair/repair.h>
#include <repair/thicken_sheets.h>

#include "complexes.h"
#include "sheets.h"

namespace meshrepair {
namespace {

using namespace testing;

RepairOptions walls_of(double thickness, ThickenSide side = ThickenSide::middle) {
  RepairOptions options;
  options.thicken.thickness = thickness;
  options.thicken.side = side;
  return options;
}

RepairResult expect_solid(const TriangleSoup& soup, const RepairOptions& options) {
  RepairResult result = repair(soup, options);
  EXPECT_TRUE(result.report.certify.passed());
  expect_closed_manifold(result.surface.mesh);
  return result;
}

TriangleSoup unit_sheet() {
  return sheet_of(1, 1, [](double u, double v) { return Vec3d(u, v, 0); });
}

TriangleSoup tube(double length) {
  TriangleSoup tube = sheet_of(24, 4, [&](double u, double v) {
    const double a = 2 * std::numbers::pi * u;
    return Vec3d(std::cos(a), std::sin(a), length * v);
  });
  // The last row of points is the first one.
  for (auto& triangle : tube.triangles) {
    for (std::uint32_t& p : triangle) p %= 24 * 5;
  }
  tube.points.resize(std::size_t{24} * 5);
  return tube;
}

TEST(ThickenSheets, AFlatSheetIsABoxOfTwelveTriangles) {
  const RepairResult result = expect_solid(unit_sheet(), walls_of(0.1));
  EXPECT_EQ(result.surface.mesh.triangles.size(), 12u);
  EXPECT_NEAR(result.report.output_volume, 0.1, 1e-9);
  EXPECT_EQ(result.report.thicken.sheets, 1u);
  EXPECT_EQ(result.report.thicken.area, 1);
}

TEST(ThickenSheets, ThicknessMayBeAShareOfTheDiagonal) {
  RepairOptions options = walls_of(0.1);
  options.thicken.is_share = true;
  EXPECT_NEAR(expect_solid(unit_sheet(), options).report.thicken.thickness, 0.1 * std::sqrt(2),
              1e-7);
}

TEST(ThickenSheets, TheSideSaysWhereTheSheetIs) {
  const auto range_of = [](ThickenSide side) {
    const TriangleSoup mesh = expect_solid(unit_sheet(), walls_of(0.1, side)).surface.mesh;
    double low = 1, high = -1;
    for (const Vec3d& p : mesh.points) {
      low = std::min(low, p.z());
      high = std::max(high, p.z());
    }
    return std::pair(low, high);
  };
  EXPECT_EQ(range_of(ThickenSide::middle), std::pair(-0.05, 0.05));
  EXPECT_EQ(range_of(ThickenSide::outside), std::pair(0.0, 0.1));
  EXPECT_EQ(range_of(ThickenSide::inside), std::pair(-0.1, 0.0));
}

// As most leaves of game trees are: the same card, once for each face.
TEST(ThickenSheets, ACardWithTwoFacesIsOneWall) {
  TriangleSoup card = unit_sheet();
  append(card, flipped(unit_sheet()));
  EXPECT_NEAR(expect_solid(card, walls_of(0.1)).report.output_volume, 0.1, 1e-9);
  // Cut along the other diagonal, and joined with it at the rim.
  TriangleSoup other = unit_sheet();
  other.triangles.insert(other.triangles.end(), {{0, 1, 3}, {0, 3, 2}});
  EXPECT_NEAR(expect_solid(other, walls_of(0.1)).report.output_volume, 0.1, 1e-9);
}

TEST(ThickenSheets, OneTriangleIsAPrism) {
  const RepairResult result = expect_solid(pages(1), walls_of(0.1));
  EXPECT_EQ(result.surface.mesh.triangles.size(), 8u);
  EXPECT_NEAR(result.report.output_volume, 0.1 * surface_area(pages(1)), 1e-9);
}

TEST(ThickenSheets, WallsMeetAtCrowdedEdges) {
  for (const std::uint32_t count : {2u, 3u, 5u, 7u}) {
    for (const ThickenSide side : {ThickenSide::middle, ThickenSide::outside}) {
      const TriangleSoup book = pages(count);
      const RepairResult result = expect_solid(book, walls_of(0.01, side));
      EXPECT_NEAR(result.report.output_volume, 0.01 * surface_area(book),
                  0.03 * 0.01 * surface_area(book))
          << count;
      EXPECT_EQ(result.report.thicken.sheets, 1u);
    }
  }
}

TEST(ThickenSheets, AMoebiusStripHasASeam) {
  const TriangleSoup strip = moebius_strip(60);
  const RepairResult result = expect_solid(strip, walls_of(0.05));
  EXPECT_NEAR(result.report.output_volume, 0.05 * surface_area(strip), 0.003);
  expect_solid(strip, walls_of(0.05, ThickenSide::outside));
}

TEST(ThickenSheets, OpenSurfacesOfAnyKindBecomeSolids) {
  for (const OpenSurface& surface : open_surfaces()) {
    SCOPED_TRACE(surface.name);
    for (const double flips : {0.0, 0.4}) {
      expect_solid(with_some_flipped(surface.soup, flips, 1), walls_of(0.03));
    }
  }
}

TEST(ThickenSheets, TheEndsOfATubeAreItsRims) {
  const TriangleSoup garment = tube(6);
  for (const HoleMode mode : {HoleMode::patch, HoleMode::none}) {
    RepairOptions options = walls_of(0.05);
    options.holes.mode = mode;
    EXPECT_NEAR(expect_solid(garment, options).report.output_volume, 0.05 * surface_area(garment),
                1e-3);
  }
  RepairOptions options = walls_of(0.05);
  options.thicken.largest_hole_share = std::numeric_limits<double>::infinity();
  EXPECT_EQ(expect_solid(garment, options).report.thicken.triangles, 0u);
}

TEST(ThickenSheets, AWallThickerThanItsTubeFillsIt) {
  RepairOptions options = walls_of(3);
  options.holes.mode = HoleMode::none;
  const RepairResult result = expect_solid(tube(4), options);
  EXPECT_EQ(result.report.output.parts, 1u);
  EXPECT_NEAR(result.report.output_volume, 4 * std::numbers::pi * 2.5 * 2.5, 3);
}

// Every other row of a saddle is a thousandth as wide as its wall is thick.
TEST(ThickenSheets, NarrowTrianglesOfACurvedSheetShareTheWall) {
  const TriangleSoup sheet = sheet_of(24, 24, [](double u, double v) {
    const int row = static_cast<int>(std::lround(24 * v));
    const double y = row / 2 / 12.0 + (row % 2) * 2e-4;
    return Vec3d(u, y, 0.7 * (u - 0.5) * (y - 0.5) + 0.3 * (u * u - y * y));
  });
  const RepairResult result = expect_solid(sheet, walls_of(0.2));
  EXPECT_EQ(result.report.thicken.folds, 0u);
  EXPECT_NEAR(result.report.output_volume, 0.2 * surface_area(sheet), 0.01);
}

// Many points at which no common direction suits all triangles.
TEST(ThickenSheets, ANoisySheetHasNoVoidsInItsWall) {
  Random random(5);
  const TriangleSoup sheet = sheet_of(24, 24, [&](double u, double v) {
    return Vec3d(u, v, 0.1 * std::sin(5 * u) + random.real(-0.01, 0.01));
  });
  for (const double thickness : {0.02, 0.1}) {
    const RepairResult result = expect_solid(sheet, walls_of(thickness));
    EXPECT_EQ(result.report.output.parts, 1u);
    EXPECT_GT(result.report.thicken.corners, 0u);
    const double volume = thickness * surface_area(sheet);
    EXPECT_NEAR(result.report.output_volume, volume, 0.05 * volume);
  }
}

TEST(ThickenSheets, SolidsStayBitForBit) {
  TriangleSoup soup = unit_sheet();
  const TriangleSoup solid = moved(sphere(500), {5, 5, 5});
  append(soup, solid);
  const RepairResult result = expect_solid(soup, walls_of(0.1));
  EXPECT_EQ(result.report.triangles.untouched, solid.triangles.size());
  EXPECT_NEAR(result.report.thicken.solid_volume, signed_volume(solid), 1e-6);
  EXPECT_NEAR(result.report.output_volume, signed_volume(solid) + 0.1, 1e-6);
  const TriangleSoup& mesh = result.surface.mesh;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t source = result.surface.source[t];
    ASSERT_LT(source, soup.triangles.size());
    if (source < 2) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(mesh.points[mesh.triangles[t][k]], soup.points[soup.triangles[source][k]]);
    }
  }
}

TEST(ThickenSheets, NothingChangesWithoutSheets) {
  for (const TriangleSoup& soup : {sphere(300), two_overlapping_spheres(300), random_cubes(5, 1)}) {
    RepairOptions options = walls_of(0.1);
    const RepairResult with = repair(soup, options);
    options.thicken = {};
    const RepairResult without = repair(soup, options);
    EXPECT_EQ(with.surface.mesh.points, without.surface.mesh.points);
    EXPECT_EQ(with.surface.mesh.triangles, without.surface.mesh.triangles);
    EXPECT_EQ(with.report.thicken.triangles, 0u);
  }
}

TEST(ThickenSheets, AFinOnASolidIsJoinedWithIt) {
  // Shares the edge from (0, 1, 1) to (1, 1, 1) with the cube, and leans.
  for (const double lean : {-0.6, 0.0, 0.4}) {
    TriangleSoup soup = cube();
    TriangleSoup fin;
    fin.points = {{0, 1, 1}, {1, 1, 1}, {1, 1 + lean, 2}, {0, 1 + lean, 2}};
    fin.triangles = {{0, 1, 2}, {0, 2, 3}};
    append(soup, fin);
    for (const ThickenSide side : {ThickenSide::middle, ThickenSide::inside}) {
      const RepairResult result = expect_solid(soup, walls_of(0.05, side));
      EXPECT_TRUE(side != ThickenSide::middle || result.report.output.parts == 1) << lean;
      EXPECT_NEAR(result.report.output_volume, 1 + 0.05 * surface_area(fin), 0.004) << lean;
    }
  }
}

TEST(ThickenSheets, ASheetInACavityIsAWallThere) {
  TriangleSoup soup = box({-2, -2, -2}, {3, 3, 3});
  append(soup, flipped(box({-1, -1, -1}, {2, 2, 2})));
  const double hollow = 125 - 27;
  append(soup, unit_sheet());
  EXPECT_NEAR(expect_solid(soup, walls_of(0.1)).report.output_volume, hollow + 0.1, 1e-6);
}

TEST(ThickenSheets, ASheetInsideASolidIsNothing) {
  TriangleSoup soup = box({-2, -2, -2}, {3, 3, 3});
  append(soup, unit_sheet());
  EXPECT_NEAR(expect_solid(soup, walls_of(0.1)).report.output_volume, 125, 1e-6);
}

TEST(ThickenSheets, AWallThatNumbersDoNotTellIsRefused) {
  for (const double thickness : {1e-9, 1e9, std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW((void)repair(unit_sheet(), walls_of(thickness)), UsageError) << thickness;
  }
  RepairOptions options = walls_of(1e-6);
  options.certify.precision = Precision::float32;
  EXPECT_THROW((void)repair(unit_sheet(), options), UsageError);
  for (const double scale : {1e-150, 1e-60, 1e60, 1e150}) {
    const TriangleSoup sheet = scaled(unit_sheet(), scale);
    if (scale == 1e-60 || scale == 1e60) {
      EXPECT_EQ(expect_solid(sheet, walls_of(0.1 * scale)).surface.mesh.triangles.size(), 12u);
    } else {
      EXPECT_THROW((void)repair(sheet, walls_of(0.1 * scale)), UsageError) << scale;
    }
  }
}

TEST(ThickenSheets, WhereNothingIsSolidAThicknessIsNamed) {
  RepairReport report;
  EXPECT_THROW((void)repair(unit_sheet(), {}, report), NoSolidError);
  EXPECT_EQ(report.thicken.fitting, 0.01);
  report = {};
  EXPECT_THROW((void)repair(TriangleSoup{}, walls_of(1), report), NoSolidError);
  EXPECT_EQ(report.thicken.fitting, 0);
}

TEST(ThickenSheets, FittingThicknessIsTakenWhereMostIsSheet) {
  RepairOptions options;
  options.thicken.automatic = true;
  TriangleSoup soup = cube();
  EXPECT_EQ(repair(soup, options).report.thicken.triangles, 0u);
  soup.points.insert(soup.points.end(), {{3, 0, 0}, {4, 0, 0}, {3, 1, 0}});
  soup.triangles.push_back({8, 9, 10});
  const RepairResult mostly_solid = repair(soup, options);
  EXPECT_EQ(mostly_solid.report.thicken.triangles, 0u);
  EXPECT_EQ(mostly_solid.surface.mesh.triangles.size(), 12u);
  soup.points[9] = {30, 0, 0};
  const RepairResult mostly_sheet = repair(soup, options);
  EXPECT_EQ(mostly_sheet.report.thicken.triangles, 1u);
  EXPECT_TRUE(mostly_sheet.report.thicken.automatic);
  EXPECT_GT(mostly_sheet.report.thicken.thickness, 0);
  EXPECT_EQ(mostly_sheet.report.output.parts, 2u);
  EXPECT_TRUE(mostly_sheet.report.certify.passed());
}

TEST(ThickenSheets, SheetsBecomeSolidsInSinglePrecision) {
  Random random(7);
  RepairOptions options = walls_of(0.02);
  options.certify.precision = Precision::float32;
  options.certify.welded = true;
  for (int i = 0; i < 10; ++i) {
    TriangleSoup soup = turned(curved_sheet(random), random);
    append(soup, turned(folded_sheet(random), random));
    expect_solid(soup, options);
  }
}

}  // namespace
}  // namespace meshrepair
