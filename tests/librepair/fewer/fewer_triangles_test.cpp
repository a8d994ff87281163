// SPDX-License-Identifier: MIT
// repair() with fewer triangles: certified as without, and told.
#include "fewer/fewer_triangles.h"

#include <gtest/gtest.h>

#include <base/parallel.h>
#include <check/check_surface.h>
#include <check/mesh_distance.h>
#include <mesh/precision.h>
#include <repair/repair.h>

#include "each_seed.h"
#include "random_geometry.h"
#include "random_solids.h"
#include "shapes.h"

namespace meshrepair {
namespace {

using namespace testing;

RepairOptions of_at_most(std::size_t triangles) {
  RepairOptions options;
  options.fewer.most = triangles;
  return options;
}

TEST(FewerTriangles, ASolidAsGivenHasAsManyAsAskedFor) {
  const TriangleSoup soup = sphere(2000);
  const RepairResult result = repair(soup, of_at_most(500));
  EXPECT_LE(result.surface.mesh.triangles.size(), 500u);
  EXPECT_GE(result.surface.mesh.triangles.size(), 499u);
  EXPECT_TRUE(result.report.certify.passed());
  EXPECT_FALSE(result.report.kept_valid);
  EXPECT_TRUE(result.report.fewer.done);
  EXPECT_EQ(result.report.fewer.before, soup.triangles.size());
  EXPECT_EQ(result.report.output.triangles, result.surface.mesh.triangles.size());
  EXPECT_TRUE(check_surface(result.surface.mesh).valid_solid());
}

TEST(FewerTriangles, ASolidThatIsSmallEnoughStaysAsItIs) {
  const TriangleSoup soup = sphere(500);
  const RepairResult result = repair(soup, of_at_most(600));
  EXPECT_EQ(result.surface.mesh.triangles, soup.triangles);
  EXPECT_EQ(result.surface.mesh.points, soup.points);
  EXPECT_TRUE(result.report.kept_valid);
}

// Rounding can leave a surface that is joined along one edge that solids share, and not along
// another.
TEST(FewerTriangles, SolidsThatTouchInTwoWaysAreReduced) {
  const TriangleSoup two = together(cube(), box({1, 1, 0}, {2, 2, 1}));
  RepairOptions join;
  join.extract.touching = Touching::join;
  Surface surface;
  surface.mesh =
      together(repair(two).surface.mesh, moved(repair(two, join).surface.mesh, Vec3d(5, 0, 0)));
  const TriangleSoup given = surface.mesh;
  surface.source.assign(given.triangles.size(), 0);
  surface.input_point.assign(given.points.size(), 1);
  RepairReport report;
  report.certify.done = true;
  internal::take_triangles_away(given, surface, of_at_most(40), report);
  EXPECT_LE(surface.mesh.triangles.size(), 40u);
  EXPECT_TRUE(check_surface(surface.mesh).valid_solid());
}

TEST(FewerTriangles, AShareIsOfTheRepairedSurface) {
  RepairOptions options;
  options.fewer.share = 0.1;
  const RepairResult result = repair(two_overlapping_spheres(4000), options);
  const FewerTrianglesReport& fewer = result.report.fewer;
  EXPECT_NEAR(static_cast<double>(fewer.asked), 0.1 * static_cast<double>(fewer.before), 1);
  EXPECT_NEAR(static_cast<double>(result.surface.mesh.triangles.size()),
              static_cast<double>(fewer.asked), 2);
  EXPECT_TRUE(check_surface(result.surface.mesh).valid_solid());
}

TEST(FewerTriangles, AShareOfLessThanATetrahedronIsOne) {
  RepairOptions options;
  options.fewer.share = 1e-6;
  const RepairResult result = repair(torus(12, 8), options);
  EXPECT_EQ(result.report.fewer.asked, 4u);
  EXPECT_TRUE(check_surface(result.surface.mesh).valid_solid());
}

// For every format, also of soups that nothing prepares for it.
TEST(FewerTriangles, SoupsBecomeSolidsWithFew) {
  for_each_seed(60, [](std::uint64_t seed) {
    Random random(seed);
    TriangleSoup soup = random_solid(random);
    for (int i = 0; i < 3; ++i) soup = together(soup, random_solid(random));
    if (seed % 3 == 0) soup = without_some(soup, 0.05, seed);
    RepairOptions options = of_at_most(40);
    options.certify.welded = seed % 2 == 0;
    if (options.certify.welded) options.certify.precision = Precision::float32;
    const RepairResult result = repair(soup, options);
    ASSERT_TRUE(result.report.certify.passed());
    CheckOptions as_read;
    as_read.weld = options.certify.welded;
    EXPECT_TRUE(check_surface(result.surface.mesh, as_read).valid_solid());
    ASSERT_EQ(result.surface.source.size(), result.surface.mesh.triangles.size());
    ASSERT_EQ(result.surface.input_point.size(), result.surface.mesh.points.size());
    for (const std::uint32_t source : result.surface.source) {
      EXPECT_TRUE(source == Surface::kNoSource || source < soup.triangles.size());
    }
    const ThreadLimit one(1);
    const TriangleSoup again = repair(soup, options).surface.mesh;
    EXPECT_EQ(again.points, result.surface.mesh.points);
    EXPECT_EQ(again.triangles, result.surface.mesh.triangles);
  });
}

TEST(FewerTriangles, ExplanationsAreOfWhatIsLeft) {
  RepairOptions options = of_at_most(200);
  options.explain = true;
  const RepairResult result = repair(two_overlapping_spheres(2000), options);
  EXPECT_EQ(result.report.explanation.origins.size(), result.surface.mesh.triangles.size());
}

// By a way that proves it otherwise, too.
TEST(FewerTriangles, NoPointIsFartherThanAskedFor) {
  const TriangleSoup soup = repair(noisy_sphere(4000, 0.01, 3), {}).surface.mesh;
  for (const double share : {0.01, 0.003, 0.001}) {
    RepairOptions options;
    options.fewer.distance = share;
    options.fewer.distance_is_share = true;
    const RepairResult result = repair(soup, options);
    const FewerTrianglesReport& fewer = result.report.fewer;
    EXPECT_FALSE(fewer.is_unproven);
    EXPECT_NEAR(fewer.most_distance, share * bounding_diagonal(soup), 1e-12);
    EXPECT_LT(result.surface.mesh.triangles.size(), soup.triangles.size());
    EXPECT_TRUE(check_surface(result.surface.mesh).valid_solid());
    DistanceOptions measuring;
    measuring.bound = true;
    measuring.bound_factor = 1.02;
    const MeshDistance distance = mesh_distance(soup, result.surface.mesh, measuring);
    EXPECT_LE(distance.largest(), fewer.most_distance);
    EXPECT_LE(*distance.bound(), 1.02 * fewer.most_distance);
  }
}

}  // namespace
}  // namespace meshrepair
