// SPDX-License-Identifier: MIT
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <check/internal/known_intersections.h>
#include <check/self_intersections.h>

#include "each_seed.h"
#include "random_geometry.h"
#include "shapes.h"
#include "share_of_cases.h"

namespace meshrepair {
namespace {

using namespace testing;
using internal::KnownIntersections;

void expect_as_whole(const SelfIntersections& found, const TriangleSoup& mesh, std::uint64_t seed) {
  SelfIntersectionOptions options;
  options.most_pairs = 1'000'000;
  const SelfIntersections whole = self_intersections(mesh, options);
  EXPECT_EQ(found.count, whole.count) << seed;
  EXPECT_EQ(found.crossing, whole.crossing) << seed;
  EXPECT_EQ(found.touching, whole.touching) << seed;
  EXPECT_EQ(found.coplanar, whole.coplanar) << seed;
  EXPECT_EQ(found.degenerate, whole.degenerate) << seed;
  EXPECT_EQ(found.not_finite, whole.not_finite) << seed;
  EXPECT_EQ(found.pairs, whole.pairs) << seed;
}

std::uint32_t any_below(Random& random, std::size_t end) {
  return static_cast<std::uint32_t>(random.integer(0, static_cast<std::int32_t>(end) - 1));
}

// A few changes of any kind: a point moves, or onto another one, a triangle goes, is there twice,
// gets points of its own, loses its area, or has a corner that is no number.
void change(TriangleSoup& mesh, Random& random) {
  const std::uint32_t t = any_below(random, mesh.triangles.size());
  const std::uint32_t p = any_below(random, mesh.points.size());
  auto& corners = mesh.triangles[t];
  switch (random.integer(0, 6)) {
    case 0:
      mesh.points[p] += 0.05 * Vec3d(random.real(-1, 1), random.real(-1, 1), random.real(-1, 1));
      break;
    case 1:
      mesh.points[p] = mesh.points[corners[0]];
      break;
    case 2:
      std::swap(corners, mesh.triangles.back());
      mesh.triangles.pop_back();
      break;
    case 3:
      mesh.triangles.push_back(corners);
      break;
    case 4:
      for (std::uint32_t& corner : corners) {
        mesh.points.push_back(Vec3d(mesh.points[corner]));
        corner = static_cast<std::uint32_t>(mesh.points.size() - 1);
      }
      break;
    case 5:
      corners[1] = corners[0];
      break;
    default:
      mesh.points.push_back({0, std::numeric_limits<double>::quiet_NaN(), 0});
      corners[2] = static_cast<std::uint32_t>(mesh.points.size() - 1);
  }
}

TEST(KnownIntersections, AreThoseOfTheWholeMeshHoweverItChanges) {
  std::size_t found = 0;
  for_each_seed(1, 20, [&](std::uint64_t seed) {
    Random random(seed);
    TriangleSoup mesh = sphere(200);
    append(mesh, moved(sphere(200), {1, 0.1, 0.2}));
    KnownIntersections known(1'000'000, nullptr);
    for (int turn = 0; turn < 8; ++turn) {
      const SelfIntersections now = known.find(mesh);
      expect_as_whole(now, mesh, seed);
      found += now.count;
      for (int i = random.integer(0, 12); i > 0; --i) change(mesh, random);
    }
  });
  EXPECT_GT(found, expected_cases(1000u));
}

// Then nothing is known of any triangle.
TEST(KnownIntersections, AreRightWhereNotAllPairsAreListed) {
  TriangleSoup mesh = sphere(200);
  append(mesh, moved(sphere(200), {1, 0.1, 0.2}));
  KnownIntersections known(3, nullptr);
  const std::size_t count = self_intersections(mesh).count;
  ASSERT_GT(count, 3u);
  EXPECT_EQ(known.find(mesh).count, count);
  EXPECT_EQ(known.find(mesh).count, count);
  mesh.points[0] *= 1.01;
  EXPECT_EQ(known.find(mesh).count, self_intersections(mesh).count);
}

TEST(KnownIntersections, AreNoneOfAnEmptyMesh) {
  KnownIntersections known(10, nullptr);
  EXPECT_EQ(known.find({}).count, 0u);
  EXPECT_EQ(known.find(sphere(50)).count, 0u);
  EXPECT_EQ(known.find({}).count, 0u);
}

}  // namespace
}  // namespace meshrepair
