// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <base/error.h>
#include <boolean/bodies.h>
#include <boolean/boolean.h>
#include <check/self_intersections.h>
#include <mesh/topology.h>

#include "each_seed.h"
#include "random_geometry.h"
#include "random_solids.h"
#include "shapes.h"
#include "share_of_cases.h"

namespace meshrepair {
namespace {

using namespace testing;

double total(const ConformingBodies& bodies) {
  double sum = 0;
  for (const BodyRegion& region : bodies.regions) sum += region.volume;
  return sum;
}

double volume_of(const std::vector<TriangleSoup>& solids, SetOperation operation) {
  BooleanReport report;
  return signed_volume(boolean(solids, operation, {}, report).mesh);
}

struct Divided {
  ConformingBodies bodies;
  BodiesReport report;
};

// Divides, and checks all that is promised.
Divided divide(const std::vector<TriangleSoup>& solids, const BodiesOptions& options) {
  Divided result;
  result.bodies = conforming_bodies(solids, options, result.report);
  EXPECT_TRUE(result.report.passed()) << result.report.pairs << ' ' << result.report.turned_edges;
  const ConformingBodies& bodies = result.bodies;
  EXPECT_EQ(bodies.mesh.triangles.size(), bodies.regions_of.size());
  EXPECT_EQ(bodies.mesh.triangles.size(), bodies.source.size());
  // Points with equal coordinates would be found to meet.
  SelfIntersectionOptions by_indices;
  by_indices.weld = false;
  const SelfIntersections found = self_intersections(bodies.mesh, by_indices);
  EXPECT_EQ(found.count + found.degenerate, 0u);
  const std::vector<TriangleSoup> boundaries = boundaries_of(bodies);
  for (std::uint32_t r = 1; r <= bodies.regions.size(); ++r) {
    const TriangleSoup& boundary = boundaries[r - 1];
    EXPECT_EQ(boundary.triangles.size(), bodies.regions[r - 1].triangles);
    EXPECT_DOUBLE_EQ(signed_volume(boundary), bodies.regions[r - 1].volume);
    if (boundary.triangles.empty()) continue;
    EXPECT_GT(bodies.regions[r - 1].volume, 0);
    EXPECT_TRUE(examine_topology(boundary.triangles, boundary.points.size()).closed());
  }
  for (const auto& [front, behind] : bodies.regions_of) {
    EXPECT_NE(front, behind);
    EXPECT_NE(behind, 0u);
  }
  return result;
}

Divided divide(const std::vector<TriangleSoup>& solids, Overlap overlap = Overlap::first) {
  BodiesOptions options;
  options.overlap = overlap;
  return divide(solids, options);
}

const BodyContact* contact(const ConformingBodies& bodies, std::uint32_t a, std::uint32_t b) {
  for (const BodyContact& one : bodies.contacts) {
    if (one.a == a && one.b == b) return &one;
  }
  return nullptr;
}

TEST(Bodies, BoxesThatShareASideHaveItsTrianglesInCommon) {
  const auto [bodies, report] = divide({cube(), box({1, 0, 0}, {3, 1, 1})});
  ASSERT_EQ(bodies.regions.size(), 2u);
  EXPECT_DOUBLE_EQ(bodies.regions[0].volume, 1);
  EXPECT_DOUBLE_EQ(bodies.regions[1].volume, 2);
  ASSERT_TRUE(contact(bodies, 1, 2) != nullptr);
  EXPECT_DOUBLE_EQ(contact(bodies, 1, 2)->area, 1);
  EXPECT_EQ(contact(bodies, 1, 2)->triangles, 2u);
  EXPECT_EQ(bodies.mesh.points.size(), 12u);
  EXPECT_EQ(bodies.mesh.triangles.size(), 22u);
  EXPECT_EQ(report.overlaps, 0u);
}

TEST(Bodies, ASmallerSideIsCutOutOfALargerOne) {
  const auto [bodies, report] = divide({cube(), box({1, 0.25, 0.25}, {2, 0.75, 0.75})});
  EXPECT_DOUBLE_EQ(bodies.regions[0].volume, 1);
  EXPECT_DOUBLE_EQ(bodies.regions[1].volume, 0.25);
  EXPECT_DOUBLE_EQ(contact(bodies, 1, 2)->area, 0.25);
  EXPECT_DOUBLE_EQ(contact(bodies, 0, 1)->area, 6 - 0.25);
}

TEST(Bodies, OverlapsGoWhereTheyAreToGo) {
  const std::vector<TriangleSoup> boxes = {box({0, 0, 0}, {2, 1, 1}), box({1, 0, 0}, {2.5, 1, 1}),
                                           box({1.5, 0, 0}, {4, 1, 1})};
  const auto expect_volumes = [&](Overlap overlap, const std::vector<double>& volumes) {
    const ConformingBodies bodies = divide(boxes, overlap).bodies;
    ASSERT_EQ(bodies.regions.size(), volumes.size());
    for (std::size_t i = 0; i < volumes.size(); ++i) {
      EXPECT_DOUBLE_EQ(bodies.regions[i].volume, volumes[i]);
    }
  };
  expect_volumes(Overlap::first, {2, 0.5, 1.5});
  expect_volumes(Overlap::last, {1, 0.5, 2.5});
  expect_volumes(Overlap::smaller, {1, 1.5, 1.5});
  expect_volumes(Overlap::own, {1, 0, 1.5, 0.5, 0.5, 0.5});
  const auto [bodies, report] = divide(boxes, Overlap::own);
  EXPECT_EQ(report.overlaps, 3u);
  EXPECT_DOUBLE_EQ(report.overlap_volume, 1.5);
  EXPECT_EQ(bodies.regions[4].bodies, (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST(Bodies, OneInsideAnotherLeavesAShell) {
  const std::vector<TriangleSoup> balls = {sphere(2000, 2), sphere(500, 1)};
  EXPECT_NEAR(divide(balls, Overlap::last).bodies.regions[0].volume,
              signed_volume(balls[0]) - signed_volume(balls[1]), 1e-12);
  const auto [bodies, report] = divide(balls, Overlap::first);
  EXPECT_EQ(bodies.regions[1].triangles, 0u);
  EXPECT_EQ(bodies.mesh.triangles.size(), balls[0].triangles.size());
}

TEST(Bodies, TheSameTwiceIsOne) {
  const auto [bodies, report] = divide({cube(), cube(), flipped(flipped(cube()))});
  EXPECT_DOUBLE_EQ(bodies.regions[0].volume, 1);
  EXPECT_EQ(bodies.regions[1].triangles + bodies.regions[2].triangles, 0u);
}

TEST(Bodies, WhatTouchesInAnEdgeOrAPointStays) {
  const auto [bodies, report] =
      divide({cube(), box({1, 1, 0}, {2, 2, 1}), box({2, 2, 1}, {3, 3, 2})});
  EXPECT_EQ(bodies.mesh.triangles.size(), 36u);
  EXPECT_EQ(bodies.mesh.points.size(), 24u - 2u - 1u);
}

TEST(Bodies, NothingIsNoBodyAndNoBodiesAreRefused) {
  BodiesReport report;
  EXPECT_TRUE(conforming_bodies(std::vector<TriangleSoup>(2), {}, report).mesh.triangles.empty());
  EXPECT_THROW((void)conforming_bodies({}, {}, report), InputError);
}

// Boxes with sides in common, and anything at random, in any order.
std::vector<TriangleSoup> random_assembly(std::uint64_t seed) {
  Random random(seed);
  std::vector<TriangleSoup> bodies;
  const std::int32_t count = random.integer(2, 6);
  for (std::int32_t i = 0; i < count; ++i) {
    bodies.push_back(random.chance(0.6) ? lattice_box(random) : random_solid(random));
  }
  return bodies;
}

TEST(Bodies, VolumesOfRandomAssembliesAddUp) {
  for_each_seed(1, 60, [](std::uint64_t seed) {
    const std::vector<TriangleSoup> solids = random_assembly(seed);
    const double whole = volume_of(solids, SetOperation::unite);
    for (const Overlap overlap : {Overlap::first, Overlap::smaller, Overlap::own}) {
      EXPECT_NEAR(total(divide(solids, overlap).bodies), whole, 1e-9 * whole);
    }
    const auto [bodies, report] = divide(solids, Overlap::first);
    // New points lie in the planes of the grid, whose step is 2^-26 of the whole.
    EXPECT_NEAR(bodies.regions[0].volume, signed_volume(solids[0]), 1e-6 * whole);
    std::vector<TriangleSoup> last = {solids.back()};
    last.insert(last.end(), solids.begin(), solids.end() - 1);
    EXPECT_NEAR(bodies.regions.back().volume, volume_of(last, SetOperation::subtract),
                1e-6 * whole);
  });
}

// Far from the origin, where single precision has few digits left. Sides that nearly coincide are
// joined before.
TEST(Bodies, AreSoundInSinglePrecision) {
  std::size_t moves = 0;
  for_each_seed(1, 20, [&](std::uint64_t seed) {
    Random random(seed);
    const bool has_common_sides = seed % 2 == 0;
    std::vector<TriangleSoup> solids;
    for (int i = 0; i < 3; ++i) {
      solids.push_back(has_common_sides ? lattice_box(random) : random_solid(random));
    }
    const Eigen::Matrix3d turn = random_rotation(random);
    for (TriangleSoup& solid : solids) {
      solid = moved(transformed(solid, turn), {1000, 3000, -2000});
      for (Vec3d& p : solid.points) p = rounded_to_float32(p);
    }
    BodiesOptions options;
    options.precision = Precision::float32;
    if (has_common_sides) options.join_gaps = {JoinGapsMode::distance, 4e-3};
    const auto [bodies, report] = divide(solids, options);
    for (const Vec3d& p : bodies.mesh.points) EXPECT_EQ(p, rounded_to_float32(p));
    moves += report.moves;
  });
  EXPECT_GE(moves, expected_cases(1u));
}

// Two boxes that touch in a face, turned: the corners of the one go to other places of the grid
// than those of the other.
TEST(Bodies, WhatTouchesInATurnedPlaneHasItsFacesInCommon) {
  for_each_seed(1, 40, [](std::uint64_t seed) {
    Random random(seed);
    const Eigen::Matrix3d turn = random_rotation(random);
    const double low = random.real(-0.5, 0.5), high = random.real(0.75, 1.5);
    std::vector<TriangleSoup> solids = {transformed(cube(), turn),
                                        transformed(box({1, low, 0.25}, {2, high, 0.75}), turn)};
    if (seed % 2 == 0) {
      for (TriangleSoup& solid : solids) {
        for (Vec3d& p : solid.points) p = rounded_to_float32(p);
      }
    }
    const auto [bodies, report] = divide(solids, {});
    const double area = 0.5 * (std::min(high, 1.0) - std::max(low, 0.0));
    ASSERT_TRUE(contact(bodies, 1, 2) != nullptr);
    EXPECT_NEAR(contact(bodies, 1, 2)->area, area, 1e-5);
    EXPECT_EQ(bodies.regions[0].parts, 1u);
    EXPECT_EQ(bodies.regions[1].parts, 1u);
    EXPECT_EQ(report.overlaps, 0u);
  });
}

// Faces that cross in slivers thinner than numbers can say.
TEST(Bodies, AreSoundWhereFacesNearlyCoincide) {
  std::size_t moves = 0;
  for_each_seed(1, 30, [&](std::uint64_t seed) {
    Random random(seed);
    const double noise = std::pow(10.0, random.real(-10, -4));
    std::vector<TriangleSoup> solids;
    for (int i = 0; i < 3; ++i) {
      solids.push_back(seed % 3 == 0 ? sphere(80) : lattice_box(random));
      for (Vec3d& p : solids.back().points) {
        for (double& x : p) x += noise * random.real(-1, 1);
      }
    }
    BodiesOptions options;
    options.overlap = Overlap::own;
    options.precision = seed % 2 == 0 ? Precision::float64 : Precision::float32;
    const auto [bodies, report] = divide(solids, options);
    moves += report.moves;
    const double whole = volume_of(solids, SetOperation::unite);
    EXPECT_NEAR(total(bodies), whole, 1e-5 * whole);
  });
  EXPECT_GE(moves, expected_cases(1u));
}

}  // namespace
}  // namespace meshrepair
