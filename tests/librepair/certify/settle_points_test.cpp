// SPDX-License-Identifier: MIT
#include "certify/settle_points.h"

#include <gtest/gtest.h>

#include <bsp/clean_soup.h>
#include <check/self_intersections.h>
#include <repair/repair.h>

#include "each_seed.h"
#include "random_geometry.h"
#include "shapes.h"
#include "surfaces.h"

namespace meshrepair {
namespace {

using namespace testing;
using internal::settle_input_points;

// A turned cube, and spikes whose tips are nearer to its faces than a step of the grid: there they
// may lie on the other side.
TriangleSoup spiked_cube(std::uint64_t seed) {
  Random random(seed);
  TriangleSoup soup = cube();
  for (int i = 0; i < 40; ++i) {
    Vec3d tip(random.real(0.1, 0.9), random.real(0.1, 0.9), 1 + random.real(-1e-8, 1e-8));
    const Vec3d a(0.02, 0, 0.1), b(-0.01, 0.02, 0.1), c(-0.01, -0.02, 0.1);
    append(soup, {{tip, tip + a, tip + b, tip + c}, {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}}});
  }
  return transformed(soup, random_rotation(random));
}

Surface without_certification(const TriangleSoup& soup) {
  RepairOptions options;
  options.certify.wanted = false;
  return repair(soup, options).surface;
}

TEST(SettlePoints, EndsWithWhatWasDecidedOnTheGrid) {
  std::size_t faults = 0;
  for_each_seed(10, [&](std::uint64_t seed) {
    const TriangleSoup soup = spiked_cube(seed);
    CleanReport cleaned;
    const Grid grid = clean_soup(soup, cleaned).grid;
    Surface surface = without_certification(soup);
    const Surface before = surface;
    faults += self_intersections(surface.mesh).count;
    internal::KnownIntersections known(1000, nullptr);
    const std::size_t moved = settle_input_points(surface, grid, known);
    EXPECT_EQ(self_intersections(surface.mesh).crossing, 0u) << seed;
    EXPECT_EQ(surface.mesh.triangles, before.mesh.triangles);
    std::size_t differ = 0;
    for (std::size_t p = 0; p < surface.mesh.points.size(); ++p) {
      const Vec3d move = surface.mesh.points[p] - before.mesh.points[p];
      differ += move == Vec3d::Zero() ? 0 : 1;
      EXPECT_LE(move.cwiseAbs().maxCoeff(), 0.51 * grid.unit) << seed;
      EXPECT_EQ(surface.input_point[p] != 0, before.input_point[p] != 0 && move == Vec3d::Zero());
    }
    EXPECT_EQ(differ, moved) << seed;
    EXPECT_LT(moved, soup.points.size()) << seed;
  });
  EXPECT_GT(faults, 0u);
}

TEST(SettlePoints, MovesNothingWhereNothingIntersects) {
  Surface surface = as_surface(sphere(500));
  const Surface before = surface;
  internal::KnownIntersections known(1000, nullptr);
  EXPECT_EQ(settle_input_points(surface, Grid{Vec3d::Zero(), 0x1p-10}, known), 0u);
  EXPECT_EQ(surface.mesh.points, before.mesh.points);
}

// Without a repair of the whole.
TEST(SettlePoints, CertificationSettlesPointsFirst) {
  for_each_seed(10, [&](std::uint64_t seed) {
    RepairOptions options;
    options.simplify = seed % 2 == 0 ? 0 : kDefaultSimplify;
    const RepairResult result = repair(spiked_cube(seed), options);
    EXPECT_TRUE(result.report.certify.passed()) << seed;
    EXPECT_EQ(result.report.certify.rounds, 0u) << seed;
  });
}

}  // namespace
}  // namespace meshrepair
