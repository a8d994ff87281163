// SPDX-License-Identifier: MIT
#include "walls/find_cavities.h"

#include <numbers>

#include <gtest/gtest.h>

#include <check/check_surface.h>
#include <check/self_intersections.h>
#include <mesh/topology.h>

#include "shapes.h"

namespace meshrepair::internal {
namespace {

using testing::append;
using testing::box;
using testing::flipped;
using testing::sphere;

Cavities cavities_of(const TriangleSoup& solid, double thickness) {
  const Depth depth(solid);
  CavityOptions options;
  options.thickness = thickness;
  options.error = 0.02 * thickness;
  return find_cavities(solid, depth, options);
}

void expect_closed(const Cavities& found) {
  const Topology topology = examine_topology(found.walls.triangles, found.walls.points.size());
  EXPECT_TRUE(topology.closed());
  EXPECT_TRUE(topology.manifold());
  EXPECT_TRUE(topology.oriented());
  EXPECT_EQ(found.unproven, 0u);
}

TEST(FindCavities, ThatOfABoxIsABox) {
  const Cavities found = cavities_of(box({0, 0, 0}, {20, 30, 10}), 1);
  expect_closed(found);
  ASSERT_EQ(found.deepest.size(), 1u);
  EXPECT_NEAR(signed_volume(found.walls), 18 * 28 * 8, 0.5);
  EXPECT_NEAR(found.deepest[0].distance, 5, 0.05);
}

TEST(FindCavities, ThatOfABallIsABall) {
  const Cavities found = cavities_of(sphere(3000), 0.3);
  expect_closed(found);
  ASSERT_EQ(found.deepest.size(), 1u);
  EXPECT_NEAR(signed_volume(found.walls), 4.0 / 3 * std::numbers::pi * 0.343, 0.03);
}

TEST(FindCavities, EachPartHasItsOwn) {
  TriangleSoup solid = box({0, 0, 0}, {4, 4, 4});
  append(solid, box({10, 0, 0}, {14, 4, 4}));
  append(solid, box({20, 0, 0}, {21, 4, 4}));  // too thin for one
  const Cavities found = cavities_of(solid, 1);
  expect_closed(found);
  EXPECT_EQ(found.deepest.size(), 2u);
  EXPECT_NEAR(signed_volume(found.walls), 16, 0.1);
}

// A void gets a wall around it, even one that is far smaller than a tetrahedron.
TEST(FindCavities, VoidsHaveWalls) {
  for (const double radius : {2.0, 0.01}) {
    TriangleSoup solid = box({0, 0, 0}, {20, 20, 20});
    append(solid, flipped(sphere(200, radius, {10, 10, 10})));
    const Cavities found = cavities_of(solid, 1);
    expect_closed(found);
    EXPECT_EQ(found.deepest.size(), 1u);
    const double ball = 4.0 / 3 * std::numbers::pi * (radius + 1) * (radius + 1) * (radius + 1);
    EXPECT_NEAR(signed_volume(found.walls), 18.0 * 18 * 18 - ball, 10);
  }
}

TEST(FindCavities, ASolidThatIsTooThinHasNone) {
  const Cavities found = cavities_of(box({0, 0, 0}, {10, 10, 1}), 0.6);
  EXPECT_TRUE(found.walls.triangles.empty());
  EXPECT_TRUE(found.deepest.empty());
  EXPECT_EQ(found.unproven, 0u);
}

TEST(FindCavities, ItsWallsDoNotIntersect) {
  const Cavities found = cavities_of(testing::torus(30, 16, 2, 0.7), 0.2);
  expect_closed(found);
  EXPECT_TRUE(self_intersections(found.walls).pairs.empty());
}

}  // namespace
}  // namespace meshrepair::internal
