// SPDX-License-Identifier: MIT
#include "polygons/ear_clipper.h"

#include <algorithm>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "large_polygons.h"

namespace meshrepair::internal {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

// A second, slow way: looks at all corners for each ear.
Triangles ears_looked_for_everywhere(const std::vector<Flat>& p, EarOrder order) {
  std::vector<std::uint32_t> ring(p.size());
  std::iota(ring.begin(), ring.end(), 0u);
  const auto at = [&](std::size_t i) { return p[ring[i % ring.size()]]; };
  const auto is_ear = [&](std::size_t i) {
    const Flat a = at(i + ring.size() - 1);
    const Flat b = at(i);
    const Flat c = at(i + 1);
    if (!(left_turn(a, b, c) > 0)) return false;
    for (std::size_t j = 0; j < ring.size(); ++j) {
      const Flat q = at(j);
      if (left_turn(at(j + ring.size() - 1), q, at(j + 1)) > 0) continue;
      if (q != a && q != b && q != c && left_turn(a, b, q) >= 0 && left_turn(b, c, q) >= 0 &&
          left_turn(c, a, q) >= 0) {
        return false;
      }
    }
    return true;
  };
  Triangles triangles;
  std::size_t i = 0;
  for (std::size_t tried = 0; ring.size() > 3 && tried < ring.size();) {
    if (!is_ear(i)) {
      i = (i + 1) % ring.size();
      ++tried;
      continue;
    }
    triangles.push_back(
        {ring[(i + ring.size() - 1) % ring.size()], ring[i], ring[(i + 1) % ring.size()]});
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
    if (order == EarOrder::in_rounds) ++i;
    i %= ring.size();
    tried = 0;
  }
  if (ring.size() == 3) {
    triangles.push_back({ring[(i + 2) % 3], ring[i], ring[(i + 1) % 3]});
  }
  return triangles;
}

std::vector<Flat> flat(const std::vector<Vec3d>& points) {
  std::vector<Flat> list;
  list.reserve(points.size());
  for (const Vec3d& p : points) list.emplace_back(p.x(), p.y());
  return list;
}

// Sum of the areas' absolute values, doubled.
double area_of(const std::vector<Flat>& p, const Triangles& triangles) {
  return std::accumulate(triangles.begin(), triangles.end(), 0.0, [&](double sum, const auto& t) {
    return sum + std::abs(left_turn(p[t[0]], p[t[1]], p[t[2]]));
  });
}

double area_of(const std::vector<Flat>& p) {
  double sum = 0;
  for (std::size_t i = 2; i < p.size(); ++i) sum += left_turn(p[0], p[i - 1], p[i]);
  return sum;
}

// On a coarse lattice, so turns are exact; points repeat, lie in line, and edges cross.
TEST(EarClipper, CutsTheEarsThatALookAtAllCornersFinds) {
  std::mt19937 random(5);
  std::size_t triangles_seen = 0;
  for (int round = 0; round < 3000; ++round) {
    SCOPED_TRACE(round);
    const std::size_t size = 4 + random() % (round % 50 == 0 ? 300 : 30);
    std::vector<Flat> polygon;
    for (std::size_t i = 0; i < size; ++i) {
      if (round % 2 == 0) {
        polygon.emplace_back(random() % 9, random() % 9);
      } else {
        const double angle = 6.28 * static_cast<double>(i) / static_cast<double>(size);
        const double radius = static_cast<double>(5 + random() % 20);
        polygon.emplace_back(std::round(radius * std::cos(angle)),
                             std::round(radius * std::sin(angle)));
      }
    }
    for (const EarOrder order : {EarOrder::around, EarOrder::in_rounds}) {
      const Triangles expected = ears_looked_for_everywhere(polygon, order);
      Triangles triangles;
      const EarClipping clipping = clip_ears(polygon, order, triangles);
      ASSERT_EQ(triangles, expected);
      ASSERT_EQ(triangles.size() + std::max<std::size_t>(clipping.rest.size(), 2), size);
      triangles_seen += expected.size();
    }
  }
  EXPECT_GT(triangles_seen, 40000u);
}

TEST(EarClipper, LooksAtFewCornersOfLargePolygons) {
  for (const auto& points : {testing::koch_curve(3, 7), testing::spiral(50, 50000)}) {
    const std::vector<Flat> polygon = flat(points);
    Triangles triangles;
    const EarClipping clipping = clip_ears(polygon, EarOrder::in_rounds, triangles);
    EXPECT_TRUE(clipping.rest.empty());
    EXPECT_EQ(triangles.size(), polygon.size() - 2);
    EXPECT_NEAR(area_of(polygon, triangles), area_of(polygon), 1e-9 * area_of(polygon));
    EXPECT_LT(clipping.looked_at, 200 * polygon.size());
  }
}

TEST(EarClipper, TrianglesAndTheRestAddUpToThePolygon) {
  std::vector<Flat> polygon = flat(testing::koch_curve(3, 5));
  std::swap(polygon[1000], polygon[1500]);  // four edges that cross many others
  Triangles triangles;
  const EarClipping clipping = clip_ears(polygon, EarOrder::in_rounds, triangles);
  ASSERT_FALSE(clipping.rest.empty());
  EXPECT_LT(clipping.rest.size(), polygon.size() / 4);
  EXPECT_TRUE(std::is_sorted(clipping.rest.begin(), clipping.rest.end()));
  std::vector<Flat> rest;
  for (const std::uint32_t corner : clipping.rest) rest.push_back(polygon[corner]);
  EXPECT_NEAR(area_of(polygon, triangles) + area_of(rest), area_of(polygon), 1e-12);
}

}  // namespace
}  // namespace meshrepair::internal
