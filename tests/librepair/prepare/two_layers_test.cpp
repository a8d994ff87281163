// SPDX-License-Identifier: MIT
// A surface that is there twice, the copy facing inward, is one surface.

#include "prepare/two_layers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include <gtest/gtest.h>

#include <mesh/precision.h>
#include <repair/repair.h>

#include "each_seed.h"
#include "open_surfaces.h"
#include "shapes.h"
#include "triangles_by_place.h"

namespace meshrepair {
namespace {

using namespace testing;

// Turned round, and each quad, which two triangles in a row are, cut along its other diagonal.
TriangleSoup cut_otherwise(const TriangleSoup& soup) {
  TriangleSoup other = soup;
  for (std::size_t t = 0; t + 1 < soup.triangles.size(); t += 2) {
    const auto [a, b, c] = soup.triangles[t];
    const std::uint32_t d = soup.triangles[t + 1][2];
    other.triangles[t] = {b, a, d};
    other.triangles[t + 1] = {b, d, c};
  }
  return other;
}

void expect_body(const TriangleSoup& two_sided, const TriangleSoup& body) {
  const RepairResult result = repair(two_sided);
  const double volume = signed_volume(body);
  EXPECT_NEAR(result.report.output_volume, volume, 1e-3 * volume);
  EXPECT_EQ(result.report.lost_area, 0);
}

class TwoLayers : public ::testing::TestWithParam<TriangleSoup> {};

INSTANTIATE_TEST_SUITE_P(Bodies, TwoLayers,
                         ::testing::Values(torus(12, 7), box({0, 0, 0}, {1, 2, 3})));

TEST_P(TwoLayers, LayersCutAlongOtherDiagonalsAreTheBody) {
  for_each_seed(4, [&](std::uint64_t seed) {
    const TriangleSoup body = placed(GetParam(), seed);
    const RepairResult result = repair(together(body, cut_otherwise(body)));
    EXPECT_EQ(triangles_by_place(result.surface.mesh), triangles_by_place(body));
    expect_body(together(cut_otherwise(body), body), body);
  });
}

TEST_P(TwoLayers, LayersApartByRoundingAreTheBody) {
  for_each_seed(6, [&](std::uint64_t seed) {
    const TriangleSoup body = placed(GetParam(), seed);
    Random random(seed);
    for (const double off : {1e-9, 1e-8, 1e-7}) {
      TriangleSoup copy = cut_otherwise(body);
      for (Vec3d& p : copy.points) {
        p += off * Vec3d(random.real(-1, 1), random.real(-1, 1), random.real(-1, 1));
      }
      expect_body(together(body, copy), body);
    }
    TriangleSoup copy = cut_otherwise(body);
    for (Vec3d& p : copy.points) {
      p = internal::rounded_to(internal::rounded_to(1.1 * p, Precision::float32) / 1.1,
                               Precision::float32);
    }
    expect_body(together(body, copy), body);
  });
}

TEST_P(TwoLayers, LayersWithMissingFacesAreTheBody) {
  for_each_seed(4, [&](std::uint64_t seed) {
    const TriangleSoup body = placed(GetParam(), seed);
    for (const double share : {0.1, 0.5, 0.9}) {
      expect_body(together(body, without_some(flipped(body), share, seed)), body);
    }
    TriangleSoup copy = cut_otherwise(body);
    copy.triangles.resize(copy.triangles.size() - 4);
    expect_body(together(body, copy), body);
  });
}

TEST_P(TwoLayers, LayersBesideAPlainBodyLeaveTheBody) {
  for_each_seed(4, [&](std::uint64_t seed) {
    const TriangleSoup plain = placed(torus(9, 5), seed);
    const TriangleSoup body = moved(placed(GetParam(), seed), {30, 0, 0});
    const TriangleSoup both = together(plain, body);
    const RepairResult result = repair(together(both, cut_otherwise(body)));
    EXPECT_EQ(triangles_by_place(result.surface.mesh), triangles_by_place(both));
  });
}

TEST(TwoLayersOfSheets, LayersOfSheetsEncloseNothing) {
  for_each_seed(6, [&](std::uint64_t seed) {
    const TriangleSoup sheet = placed(wavy_sheet(5), seed);
    EXPECT_THROW((void)repair(together(sheet, flipped(sheet))), NoSolidError);
    EXPECT_THROW((void)repair(together(sheet, cut_otherwise(sheet))), NoSolidError);
    RepairOptions walls;
    walls.thicken.thickness = 0.01;
    const RepairReport report = repair(together(sheet, cut_otherwise(sheet)), walls).report;
    EXPECT_NEAR(report.output_volume, 0.01 * surface_area(sheet),
                0.02 * surface_area(sheet) * 0.01);
  });
}

// A plate has walls between its layers, and a flake no other face.
TEST(TwoLayersOfSolids, AreThinSolids) {
  const TriangleSoup plate = box({0, 0, 0}, {1, 1, 0x1p-22});
  EXPECT_EQ(repair(together(cube(), moved(plate, {2, 0, 0}))).report.output.parts, 2u);
  TriangleSoup flake;
  flake.points = {{0, 0, 0}, {1, 0, 0.1}, {1, 1, 0}, {0, 1, 0.1}};
  flake.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}};
  if (signed_volume(flake) < 0) flake = flipped(flake);
  TriangleSoup broken = moved(torus(9, 5), {9, 0, 0});
  broken.triangles.pop_back();
  EXPECT_EQ(repair(together(flake, broken)).report.output.parts, 2u);
}

// Where only a few of many faces lie on each other, they are left as they are.
TEST(TwoLayersOfSolids, AreNotMadeOfAFewFaces) {
  const TriangleSoup body = torus(40, 20);
  TriangleSoup soup = body;
  const TriangleSoup other = cut_otherwise(body);
  soup.triangles.insert(soup.triangles.end(), other.triangles.begin(), other.triangles.begin() + 2);
  CleanReport report;
  CleanSoup clean = clean_soup(soup, report);
  internal::join_cuts(clean, nullptr);
  EXPECT_EQ(clean.triangles.size(), soup.triangles.size());
}

}  // namespace
}  // namespace meshrepair
