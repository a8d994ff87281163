// SPDX-License-Identifier: MIT
#include "raster/visible_triangles.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "shapes.h"

namespace meshrepair {
namespace {

constexpr std::uint32_t kNobody = ~std::uint32_t{0};

// Of each sample the triangle, twice its number if it is seen from behind one more.
std::vector<std::uint32_t> look(const TriangleSoup& soup, const Camera& camera, unsigned samples) {
  const VisibleTriangles visible(soup, camera, samples);
  std::vector<std::uint32_t> all;
  SharedProgress progress(nullptr, 1);
  std::vector<VisibleTriangles::Sample> band;
  for (std::size_t i = 0; i < visible.bands(); ++i) {
    visible.look(i, progress, band);
    for (const auto sample : band) {
      const auto [triangle, behind] = VisibleTriangles::seen(sample);
      all.push_back(sample == VisibleTriangles::kNothing ? kNobody : 2 * triangle + behind);
    }
  }
  return all;
}

TEST(VisibleTriangles, TheNearestIsSeen) {
  TriangleSoup soup = testing::box({-1, 2, -1}, {1, 3, 1});
  testing::append(soup, testing::box({-0.5, 0, -0.5}, {0.5, 1, 0.5}));
  const Camera camera(*view_of("front"), {20, 20}, {&soup});
  const std::vector<std::uint32_t> seen = look(soup, camera, 2);
  ASSERT_EQ(seen.size(), 1600U);
  EXPECT_GE(seen[20 * 40 + 20], 24U);  // of the second box, which has 12 triangles
  EXPECT_LT(seen[5 * 40 + 20], 24U);
  EXPECT_EQ(seen[0], kNobody);
}

TEST(VisibleTriangles, ClosedSurfacesAreNeverSeenFromBehind) {
  for (const TriangleSoup& soup :
       {testing::sphere(5000), testing::torus(60, 40), testing::box({0, 0, 0}, {1, 2, 3})}) {
    for (const char* view : {"front", "iso", "12,34", "bottom"}) {
      const Camera camera(*view_of(view), {90, 90}, {&soup});
      std::size_t covered = 0;
      for (const std::uint32_t seen : look(soup, camera, 3)) {
        if (seen == kNobody) continue;
        ++covered;
        ASSERT_EQ(seen % 2, 0U) << view;
      }
      EXPECT_GT(covered, 10000U);
    }
  }
}

TEST(VisibleTriangles, FlippedTrianglesAreSeenFromBehind) {
  const TriangleSoup soup = testing::flipped(testing::sphere(500));
  const Camera camera(*view_of("iso"), {50, 50}, {&soup});
  for (const std::uint32_t seen : look(soup, camera, 1)) {
    EXPECT_TRUE(seen == kNobody || seen % 2 == 1);
  }
}

TEST(VisibleTriangles, FacingTriangleOfTwoInOnePlaceIsSeen) {
  const TriangleSoup sheet{{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 2}, {0, 1, 2}}};
  const Camera camera(*view_of("front"), {20, 20}, {&sheet});
  for (const std::uint32_t seen : look(sheet, camera, 1)) {
    EXPECT_TRUE(seen == kNobody || seen == 2) << seen;
  }
}

TEST(VisibleTriangles, TheOrderOfTrianglesDoesNotMatter) {
  const TriangleSoup soup = testing::noisy_sphere(3000, 0.3, 9);
  const Camera camera(*view_of("iso"), {80, 60}, {&soup});
  std::vector<std::uint32_t> order(soup.triangles.size());
  std::iota(order.begin(), order.end(), 0U);
  std::shuffle(order.begin(), order.end(), std::mt19937_64(1));
  TriangleSoup shuffled = soup;
  for (std::size_t i = 0; i < order.size(); ++i) {
    shuffled.triangles[i] = soup.triangles[order[i]];
  }
  std::vector<std::uint32_t> seen = look(shuffled, camera, 2);
  for (std::uint32_t& each : seen) {
    if (each != kNobody) each = 2 * order[each / 2] + each % 2;
  }
  EXPECT_EQ(seen, look(soup, camera, 2));
}

TEST(VisibleTriangles, NeedlesFromTopToBottomAreInAllBands) {
  TriangleSoup soup;
  for (std::uint32_t i = 0; i < 50; ++i) {
    const double x = i;
    soup.points.insert(soup.points.end(), {{x, 0, 0}, {x + 0.9, 0, 0}, {x + 0.45, 0, 100}});
    soup.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const Camera camera(*view_of("front"), {200, 200}, {&soup});
  const std::vector<std::uint32_t> seen = look(soup, camera, 1);
  for (std::size_t row = 15; row < 180; ++row) {
    const auto begin = seen.begin() + static_cast<std::ptrdiff_t>(200 * row);
    EXPECT_GT(std::count_if(begin, begin + 200, [](std::uint32_t s) { return s != kNobody; }), 5)
        << row;
  }
}

}  // namespace
}  // namespace meshrepair
