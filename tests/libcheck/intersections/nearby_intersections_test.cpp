// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include <check/internal/nearby_intersections.h>
#include <check/self_intersections.h>

#include "each_seed.h"
#include "random_geometry.h"
#include "shapes.h"
#include "share_of_cases.h"

namespace meshrepair {
namespace {

using namespace testing;
using internal::NearbyIntersections;

std::vector<NearbyIntersections::Pair> sorted(std::vector<NearbyIntersections::Pair> pairs) {
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

// Two spheres that cross, points of which move up and down by up to the reach.
TEST(NearbyIntersections, AreThoseOfTheWholeMeshWhereverPointsMove) {
  constexpr double kReach = 0.02;
  std::size_t found = 0;
  for_each_seed(1, 10, [&](std::uint64_t seed) {
    Random random(seed);
    TriangleSoup mesh = sphere(300);
    append(mesh, moved(sphere(300), {1, 0.1, 0.2}));
    const std::vector<Vec3d> first = mesh.points;
    std::vector<std::uint32_t> moving;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      if (random.integer(0, 3) == 0) moving.push_back(t);
    }
    NearbyIntersections nearby(mesh, moving, std::sqrt(3.0) * kReach);
    for (int turn = 0; turn < 5; ++turn) {
      for (const std::uint32_t t : moving) {
        for (const std::uint32_t p : mesh.triangles[t]) {
          for (int axis = 0; axis < 3; ++axis) {
            mesh.points[p][axis] = first[p][axis] + kReach * random.real(-1, 1);
          }
        }
      }
      std::vector<std::uint32_t> among;
      for (const std::uint32_t t : moving) {
        if (random.integer(0, 1) == 0) among.push_back(t);
      }
      const auto pairs = sorted(nearby.find(among, nullptr));
      SelfIntersectionOptions options;
      options.most_pairs = 1'000'000;
      EXPECT_EQ(pairs, self_intersections(mesh, among, options).pairs) << seed;
      found += pairs.size();
    }
  });
  EXPECT_GT(found, expected_cases(500u));
}

TEST(NearbyIntersections, OfNothingAreNone) {
  const TriangleSoup mesh = sphere(100);
  NearbyIntersections nearby(mesh, {}, 1);
  EXPECT_TRUE(nearby.find({}, nullptr).empty());
}

}  // namespace
}  // namespace meshrepair
