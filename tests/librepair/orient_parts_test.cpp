#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <repair/orient_parts.h>

#include "degenerate_soups.h"
#include "trees.h"

namespace meshrepair {
namespace {

using namespace testing;

TriangleSoup moebius_strip(std::uint32_t n) {
  TriangleSoup strip;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double a = 2 * std::numbers::pi * i / n;
    const Vec3d middle(3 * std::cos(a), 3 * std::sin(a), 0);
    const Vec3d across(std::cos(a / 2) * std::cos(a), std::cos(a / 2) * std::sin(a),
                       std::sin(a / 2));
    strip.points.push_back(middle - across);
    strip.points.push_back(middle + across);
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t a = 2 * i, b = 2 * i + 1;
    const bool last = i + 1 == n;
    const std::uint32_t c = last ? 1 : a + 2, d = last ? 0 : b + 2;
    strip.triangles.push_back({a, c, b});
    strip.triangles.push_back({b, c, d});
  }
  return strip;
}

TEST(OrientParts, AConsistentSoupIsNotChanged) {
  for (const TriangleSoup& soup : {cube(), flipped(cube()), torus(12, 9), sphere(300),
                                   without_some(sphere(300), 0.1, 1), random_cubes(5, 1)}) {
    const CleanSoup clean = cleaned(soup);
    OrientReport report;
    EXPECT_EQ(orient_parts(clean, report).raw(), windings_of(clean).raw());
    EXPECT_EQ(report.turned_triangles, 0u);
    EXPECT_EQ(report.unorientable_parts, 0u);
  }
}

TEST(OrientParts, FlippedTrianglesAreTurnedBack) {
  TriangleSoup soup = torus(16, 12);
  append(soup, moved(sphere(300), {10, 0, 0}));
  const CleanSoup clean = cleaned(soup);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const CleanSoup turned = cleaned(with_some_flipped(soup, 0.25, seed));
    OrientReport report;
    EXPECT_EQ(orient_parts(turned, report).raw(), windings_of(clean).raw());
    EXPECT_EQ(report.parts, 2u);
    EXPECT_EQ(report.unorientable_parts, 0u);
    EXPECT_GT(report.turned_triangles, 50u);
  }
}

// Area decides, not the number of triangles.
TEST(OrientParts, TheSmallerAreaIsTurned) {
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {0, -1, 0}, {5, -1, 0}};
  soup.triangles = {{0, 3, 1}, {3, 1, 4}, {0, 2, 1}};  // the large one disagrees with the first
  const CleanSoup clean = cleaned(soup);
  OrientReport report;
  const auto winding = orient_parts(clean, report);
  EXPECT_EQ(report.parts, 1u);
  EXPECT_EQ(winding[TriangleId(2u)], clean.triangles[TriangleId(2u)].winding);
  EXPECT_EQ(winding[TriangleId(0u)], -clean.triangles[TriangleId(0u)].winding);
}

TEST(OrientParts, AMoebiusStripIsLeftAsItIs) {
  for (std::uint32_t n = 5; n < 12; ++n) {
    SCOPED_TRACE(n);
    TriangleSoup soup = moebius_strip(n);
    append(soup, moved(with_some_flipped(sphere(200), 0.2, n), {20, 0, 0}));
    const CleanSoup clean = cleaned(soup);
    OrientReport report;
    const auto winding = orient_parts(clean, report);
    EXPECT_EQ(report.parts, 2u);
    EXPECT_EQ(report.unorientable_parts, 1u);
    EXPECT_GT(report.turned_triangles, 0u);
    for (std::uint32_t t = 0; t < 2 * n; ++t) {
      EXPECT_EQ(winding[TriangleId(t)], clean.triangles[TriangleId(t)].winding);
    }
  }
}

// Nothing can be said across an edge with more than two triangles.
TEST(OrientParts, EdgesWithManyTrianglesSeparateParts) {
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}};
  soup.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  OrientReport report;
  const CleanSoup clean = cleaned(soup);
  EXPECT_EQ(orient_parts(clean, report).raw(), windings_of(clean).raw());
  EXPECT_EQ(report.parts, 3u);
}

TEST(OrientParts, NothingHasNoParts) {
  OrientReport report;
  EXPECT_EQ(orient_parts(CleanSoup{}, report).size(), 0u);
  EXPECT_EQ(report.parts, 0u);
}

}  // namespace
}  // namespace meshrepair
