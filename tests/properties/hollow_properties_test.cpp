// SPDX-License-Identifier: MIT
// Random solids get cavities: certified, with walls within their bounds, and drained.
#include <cmath>
#include <cstddef>

#include <gtest/gtest.h>

#include <check/mesh_distance.h>
#include <hollow/hollow.h>

#include "each_seed.h"
#include "shapes.h"

namespace meshrepair {
namespace {

using namespace testing;

TriangleSoup noisy_ball(Random& random) {
  TriangleSoup soup = sphere(300);
  for (Vec3d& point : soup.points) point *= random.real(0.9, 1.1);
  return soup;
}

TriangleSoup random_body(Random& random) {
  switch (random.integer(0, 3)) {
    case 0:
      return box({0, 0, 0}, {random.real(0.5, 2), random.real(0.5, 2), random.real(0.5, 2)});
    case 1:
      return torus(16, 10, 1, random.real(0.2, 0.6));
    case 2:
      return noisy_ball(random);
    default:
      return sphere(400, random.real(0.4, 1));
  }
}

// Some bodies, turned and beside each other or not, and sometimes a void.
TriangleSoup bodies_to_hollow(Random& random) {
  TriangleSoup soup;
  const int bodies = random.integer(1, 3);
  for (int i = 0; i < bodies; ++i) {
    const Vec3d at(random.real(-1, 1), random.real(-1, 1), random.real(-1, 1));
    append(soup, moved(transformed(random_body(random), random_rotation(random)), at));
  }
  if (random.integer(0, 2) == 0) append(soup, flipped(sphere(100, 0.1, soup.points[0] * 0.5)));
  return soup;
}

void expect_hollow(const Surface& solid, const HollowOptions& options, const RepairOptions& how) {
  RepairReport report;
  HollowReport hollowed;
  const Surface result = hollow(solid, options, how, hollowed, report);
  if (hollowed.cavities.empty()) return;
  EXPECT_TRUE(report.certify.passed());
  EXPECT_EQ(hollowed.unproven, 0u);
  EXPECT_GE(hollowed.least, options.wall * (1 - kHollowError));
  EXPECT_LE(hollowed.most, options.wall * (1 + kHollowError));
  double cavities = 0;
  for (const Cavity& cavity : hollowed.cavities) {
    EXPECT_EQ(cavity.opens, !cavity.drains.empty());
    EXPECT_GE(cavity.diameter, hollowed.least_diameter);
    cavities += cavity.volume;
  }
  EXPECT_LE(report.output_volume, (hollowed.volume_before - cavities) * (1 + 1e-6));
  // Another way: from samples.
  if (options.drain > 0) return;  // the sides of drains have no source either
  TriangleSoup walls;
  walls.points = result.mesh.points;
  for (std::size_t t = 0; t < result.source.size(); ++t) {
    if (result.source[t] == Surface::kNoSource) walls.triangles.push_back(result.mesh.triangles[t]);
  }
  DistanceOptions sampling;
  sampling.samples = 2000;
  EXPECT_LE(one_sided_distance(walls, solid.mesh, sampling).largest, hollowed.most * (1 + 1e-9));
}

TEST(HollowProperties, WallsOfRandomSolidsAreProvenAndDrained) {
  for_each_seed(20, [](std::uint64_t seed) {
    Random random(seed);
    RepairOptions how;
    if (random.integer(0, 1) == 0) {
      how.certify.precision = Precision::float32;
      how.certify.welded = true;
    }
    RepairReport report;
    const Surface solid = repair(bodies_to_hollow(random), how, report);
    ASSERT_TRUE(report.certify.passed());
    const double size = bounding_diagonal(solid.mesh);
    for (const double share : {0.05, 0.08, 0.12}) {
      HollowOptions options;
      options.wall = share * size;
      if (random.integer(0, 1) == 0) options.drain = random.real(0.2, 1.5) * options.wall;
      expect_hollow(solid, options, how);
    }
  });
}

}  // namespace
}  // namespace meshrepair
