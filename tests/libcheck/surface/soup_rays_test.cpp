// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include <check/soup_rays.h>
#include <exact/double_predicates.h>

#include "each_seed.h"
#include "random_geometry.h"
#include "shapes.h"
#include "surface/column_ray.h"

namespace meshrepair {
namespace {

using namespace testing;

std::vector<std::int32_t> once(const TriangleSoup& soup) {
  return std::vector<std::int32_t>(soup.triangles.size(), 1);
}

TEST(SoupRays, CountsHowOftenBoxesAreAround) {
  TriangleSoup soup = box({0, 0, 0}, {8, 8, 8});
  append(soup, box({4, 4, 4}, {12, 12, 12}));
  append(soup, flipped(box({1, 1, 1}, {3, 3, 3})));
  const std::vector<std::int32_t> winding = once(soup);
  const SoupRays rays(soup, winding);
  const auto in = [](const Vec3d& p, double low, double high) {
    return (p.array() > low).all() && (p.array() < high).all() ? 1 : 0;
  };
  // Many rays run up along faces, edges and corners; no start is on one.
  for (double x = -1; x <= 13; ++x) {
    for (double y = -1; y <= 13; ++y) {
      for (double z = -0.5; z <= 13; ++z) {
        const bool on_wall = x == 0 || x == 1 || x == 3 || x == 4 || x == 8 || x == 12 || y == 0 ||
                             y == 1 || y == 3 || y == 4 || y == 8 || y == 12;
        const Vec3d p(x, y, z);
        if (on_wall) continue;
        EXPECT_EQ(rays.winding_at(p), in(p, 0, 8) + in(p, 4, 12) - in(p, 1, 3)) << p.transpose();
      }
    }
  }
}

TEST(SoupRays, WindingsCountAsOftenAsTheySay) {
  const TriangleSoup soup = box({0, 0, 0}, {8, 8, 8});
  const std::vector<std::int32_t> winding(soup.triangles.size(), -3);
  const SoupRays rays(soup, winding);
  EXPECT_EQ(rays.winding_at({4, 4, 4}), -3);
  EXPECT_EQ(rays.winding_at({4, 4, 9}), 0);
  EXPECT_EQ(rays.winding_at({4, 4, -9}), 0);
}

// 1 where the triangle faces up, -1 where it faces down, 0 where it is upright.
int facing(const TriangleSoup& soup, std::uint32_t triangle) {
  const auto& c = soup.triangles[triangle];
  return orientation_along(2, soup.points[c[0]], soup.points[c[1]], soup.points[c[2]]);
}

// From the first corners of all triangles that are not upright.
std::vector<CornerRay> rays_of_first_corners(const TriangleSoup& soup) {
  std::vector<CornerRay> first;
  for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
    if (facing(soup, t) != 0) first.push_back({t, 0});
  }
  return first;
}

// One by one.
std::vector<std::uint32_t> passed_by(const TriangleSoup& soup, const CornerRay& ray) {
  const auto start = internal::RayStart::in(soup, soup.triangles[ray.triangle]);
  std::vector<std::uint32_t> passed;
  for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
    const auto& c = soup.triangles[t];
    const int way =
        internal::passed_upward(soup.points[c[0]], soup.points[c[1]], soup.points[c[2]], start);
    if (t != ray.triangle && way != 0) passed.push_back(t);
  }
  return passed;
}

TEST(TrianglesAbove, AreThoseThatTheRayPasses) {
  for_each_seed(100, [&](std::uint64_t seed) {
    const TriangleSoup soup = random_soup(10 + 3 * seed, seed % 2 == 0 ? 4 : 1 << 12, seed);
    const std::vector<CornerRay> asked = rays_of_first_corners(soup);
    const auto above = triangles_above(soup, asked);
    ASSERT_EQ(above.size(), asked.size());
    for (std::size_t i = 0; i < asked.size(); ++i) {
      EXPECT_EQ(above[i], passed_by(soup, asked[i])) << "ray " << i;
    }
  });
}

// Above a triangle that faces up lies what is in front of it, else what is behind. By several
// threads.
TEST(TrianglesAbove, TellTheWinding) {
  TriangleSoup soup = sphere(50'000, 2);
  append(soup, sphere(500, 1));
  const std::vector<CornerRay> asked = rays_of_first_corners(soup);
  EXPECT_GT(asked.size(), soup.triangles.size() / 2);
  const auto above = triangles_above(soup, asked);
  ASSERT_EQ(above.size(), asked.size());
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const std::uint32_t own = asked[i].triangle;
    const int in_front = soup.points[soup.triangles[own][0]].norm() < 1.5 ? 1 : 0;
    int sum = 0;
    for (const std::uint32_t t : above[i]) sum += facing(soup, t);
    EXPECT_EQ(sum, in_front + (facing(soup, own) > 0 ? 0 : 1)) << "ray " << i;
    EXPECT_TRUE(std::is_sorted(above[i].begin(), above[i].end()));
  }
}

// Each corner has its own ray, beside the other ones of its triangle.
TEST(TrianglesAbove, AreOfTheCornerThatIsAskedFor) {
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {5, -1, 1}, {9, -1, 1}, {9, 3, 1}};
  soup.triangles = {{0, 1, 2}, {3, 4, 5}};
  const std::vector<CornerRay> asked = {{0, 0}, {0, 1}, {0, 2}, {1, 0}};
  const std::vector<std::vector<std::uint32_t>> expected = {{}, {1}, {}, {}};
  EXPECT_EQ(triangles_above(soup, asked), expected);
  EXPECT_TRUE(triangles_above(soup, {}).empty());
}

TEST(SoupRays, SeesOnlyWhatIsCertainlyFree) {
  const TriangleSoup soup = box({0, 0, 0}, {8, 8, 8});
  const std::vector<std::int32_t> winding = once(soup);
  const SoupRays rays(soup, winding);
  EXPECT_TRUE(rays.sees({4, 4, 9}, {4, 4, 100}));
  EXPECT_TRUE(rays.sees({4, 4, 9}, {100, 50, 9}));
  EXPECT_TRUE(rays.sees({1, 1, 1}, {7, 7, 7}));
  EXPECT_FALSE(rays.sees({4, 4, 9}, {4, 4, -9}));
  EXPECT_FALSE(rays.sees({4, 4, 4}, {40, 40, 40}));  // through a corner
  EXPECT_FALSE(rays.sees({-1, 3, 8}, {40, 3, 8}));   // in a face
  EXPECT_FALSE(rays.sees({-1, 1, 4}, {1, -1, 4}));   // through an edge
  Random random(1);
  for (int i = 0; i < 300; ++i) {
    const Vec3d inside(random.real(0.1, 7.9), random.real(0.1, 7.9), random.real(0.1, 7.9));
    const Vec3d outside = Vec3d(4, 4, 4) + 20 * Vec3d(random.real(-1, 1), random.real(-1, 1), 1);
    EXPECT_FALSE(rays.sees(inside, outside));
    EXPECT_TRUE(rays.sees(outside, outside + Vec3d(random.real(-9, 9), random.real(-9, 9), 9)));
  }
}

}  // namespace
}  // namespace meshrepair
