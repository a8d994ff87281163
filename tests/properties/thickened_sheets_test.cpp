// SPDX-License-Identifier: MIT
// Random sheets as walls: certified, of the right volume, and everywhere as far from the sheet as
// was asked for.
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <check/soup_rays.h>
#include <repair/repair.h>

#include "complexes.h"
#include "each_seed.h"
#include "sheets.h"

namespace meshrepair {
namespace {

using namespace testing;

struct Case {
  std::string name;
  TriangleSoup sheets;  // all of them
  TriangleSoup solid;
  double covered_area = 0;  // of the sheets, inside the solid, or in walls of others
  bool is_exact = true;     // the area is known
};

Case sheet_case(std::uint64_t seed) {
  Random random(seed);
  const auto turned_with = [&](const auto& make) { return turned(make(random), random); };
  switch (seed % 6) {
    case 0:
      return {"flat", turned_with(flat_sheet), {}};
    case 1:
      return {"curved", turned_with(curved_sheet), {}};
    case 2:
      return {"folded", turned_with(folded_sheet), {}};
    case 3:
      return {"tip", turned_with(tip_sheet), {}};
    case 4: {
      Case crossing{"crossing each other", turned_with(curved_sheet), {}};
      append(crossing.sheets, moved(turned_with(flat_sheet), {0.1, 0.2, 0.1}));
      append(crossing.sheets, moved(turned_with(folded_sheet), {0.3, -0.1, 0.2}));
      crossing.is_exact = false;
      return crossing;
    }
    default: {
      // Through the middle of a cube, in any direction.
      const double size = random.real(0.5, 0.9);
      const Vec3d middle(0.5, 0.5, 0);
      Case through{"crossing a solid",
                   sheet_of(3, 2, [](double u, double v) { return Vec3d(u, v, 0); }),
                   box(middle - Vec3d::Constant(size / 2), middle + Vec3d::Constant(size / 2))};
      through.covered_area = size * size;
      const Eigen::Matrix3d turn = random_rotation(random);
      through.sheets = transformed(through.sheets, turn);
      through.solid = transformed(through.solid, turn);
      return through;
    }
  }
}

RepairOptions walls_of(double thickness) {
  RepairOptions options;
  options.thicken.thickness = thickness;
  return options;
}

bool is_inside(const SoupRays& rays, const Vec3d& p) { return rays.winding_at(p) > 0; }

// From the sheet to the surface, but for rims, and for what is inside the solid.
void expect_distance(const Case& one, const TriangleSoup& walls, double half, Random& random) {
  const SheetDistance distance(one.sheets);
  const SheetDistance to_solid(one.solid);
  for (std::size_t t = 0; t < walls.triangles.size(); ++t) {
    const Vec3d p = random_place(walls, t, random);
    if (!one.solid.triangles.empty() && to_solid(p).distance < 1e-6) continue;
    const NearestPlace nearest = distance(p);
    EXPECT_LE(nearest.distance, half * (1 + kMostBeside)) << p.transpose();
    if (nearest.rim <= 1.1 * half) continue;
    EXPECT_GE(nearest.distance, half * (1 - kMostBeside)) << p.transpose();
  }
}

// Nothing is open between the sheet and the surface.
void expect_filled(const Case& one, const TriangleSoup& walls, double half, Random& random) {
  const std::vector<std::int32_t> once(walls.triangles.size(), 1);
  const SoupRays rays(walls, once);
  const SheetDistance distance(one.sheets);
  for (std::size_t t = 0; t < one.sheets.triangles.size(); ++t) {
    const auto& [a, b, c] = one.sheets.triangles[t];
    const auto& at = one.sheets.points;
    const Vec3d normal = (at[b] - at[a]).cross(at[c] - at[a]).normalized();
    const Vec3d p = random_place(one.sheets, t, random);
    if (distance(p).rim < half) continue;  // rims of curved sheets lean
    for (const double along : {-0.95, -0.3, 0.01, 0.4, 0.95}) {
      EXPECT_TRUE(is_inside(rays, p + along * half * normal)) << t << ", " << along;
    }
  }
}

// Of a case, as walls.
RepairReport expect_walls(const Case& one, double thickness, std::uint64_t seed) {
  TriangleSoup soup = one.sheets;
  append(soup, one.solid);
  const RepairResult result = repair(soup, walls_of(thickness));
  EXPECT_TRUE(result.report.certify.passed());
  expect_closed_manifold(result.surface.mesh);
  EXPECT_EQ(result.report.thicken.triangles, one.sheets.triangles.size());
  Random random(seed);
  expect_distance(one, result.surface.mesh, thickness / 2, random);
  expect_filled(one, result.surface.mesh, thickness / 2, random);
  return result.report;
}

// Each of the parameters stands for several seeds.
class ThickenedSheets : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(ThickenedSheets, AreAsThickAsAskedFor) {
  constexpr double kThickness = 0.02;
  for_each_seed(20 * GetParam(), 20, [&](std::uint64_t seed) {
    const Case one = sheet_case(seed);
    SCOPED_TRACE(one.name + ", seed " + std::to_string(seed));
    const RepairReport report = expect_walls(one, kThickness, seed);
    EXPECT_TRUE(report.output.parts == 1 || seed % 6 == 4) << "a void inside a wall";
    const double area = surface_area(one.sheets) - one.covered_area;
    const double volume = signed_volume(one.solid) + area * kThickness;
    EXPECT_LE(report.output_volume, volume + 0.05 * area * kThickness);
    EXPECT_GE(report.output_volume, volume - (one.is_exact ? 0.05 : 0.2) * area * kThickness);
  });
}

// Thicker than they are curved, and than their triangles are large.
TEST_P(ThickenedSheets, MayCrossThemselves) {
  for_each_seed(7 * GetParam(), 7, [&](std::uint64_t seed) {
    const Case one = sheet_case(seed);
    SCOPED_TRACE(one.name + ", seed " + std::to_string(seed));
    expect_walls(one, seed % 4 < 2 ? 0.5 : 0.15, seed);
  });
}

INSTANTIATE_TEST_SUITE_P(Seeds, ThickenedSheets,
                         ::testing::Range(std::uint64_t{0}, std::uint64_t{10}));

}  // namespace
}  // namespace meshrepair
