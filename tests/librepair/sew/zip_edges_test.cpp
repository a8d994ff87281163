// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>
#include <iterator>
#include <map>
#include <random>
#include <set>
#include <utility>

#include <gtest/gtest.h>

#include <repair/orient_parts.h>
#include <repair/repair_options.h>
#include <repair/repair_report.h>

#include "each_seed.h"
#include "prepare/prepare.h"
#include "sew/close_slits.h"
#include "shapes.h"
#include "share_of_cases.h"

namespace meshrepair {
namespace {

using namespace testing;

using Edge = std::pair<PointId, PointId>;

// How often edges are passed one way more than the other, but for those passed as often.
std::map<Edge, std::int64_t> unbalanced(const CleanSoup& soup) {
  std::map<Edge, std::int64_t> sums;
  for (const Triangle& t : soup.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const PointId a = t.corners[k], b = t.corners[(k + 1) % 3];
      sums[std::minmax(a, b)] += a < b ? t.layers : -t.layers;
    }
  }
  std::erase_if(sums, [](const auto& edge) { return edge.second == 0; });
  return sums;
}

// Six times the volume in cubic grid steps, modulo 2^64, exactly.
std::uint64_t steps_in(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  const auto at = [](std::int32_t x) { return static_cast<std::uint64_t>(std::int64_t{x}); };
  return at(a.x) * (at(b.y) * at(c.z) - at(b.z) * at(c.y)) +
         at(a.y) * (at(b.z) * at(c.x) - at(b.x) * at(c.z)) +
         at(a.z) * (at(b.x) * at(c.y) - at(b.y) * at(c.x));
}

std::uint64_t steps_in(const CleanSoup& soup) {
  std::uint64_t sum = 0;
  for (const Triangle& t : soup.triangles) {
    const auto& [a, b, c] = t.corners;
    sum += static_cast<std::uint64_t>(t.layers) *
           steps_in(soup.grid_points[a], soup.grid_points[b], soup.grid_points[c]);
  }
  return sum;
}

std::uint64_t volume_on_grid(const TriangleSoup& soup, const Grid& grid) {
  std::uint64_t sum = 0;
  for (const auto& [a, b, c] : soup.triangles) {
    sum += steps_in(grid.to_grid(soup.points[a]), grid.to_grid(soup.points[b]),
                    grid.to_grid(soup.points[c]));
  }
  return sum;
}

// Some balls of few grid steps, which may cross, and a cube far off that makes the steps large.
TriangleSoup balls_of_few_steps(std::uint64_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-3, 3), size(0.5, 8);
  TriangleSoup soup;
  const unsigned balls = 1 + random() % 4;
  for (unsigned i = 0; i < balls; ++i) {
    TriangleSoup ball = sphere(20 + random() % 400);
    const Vec3d scale(size(random), size(random), i % 2 == 0 ? 0.3 : size(random));
    const Vec3d middle(place(random), place(random), place(random));
    for (Vec3d& p : ball.points) p = p.cwiseProduct(scale) + middle;
    append(soup, ball);
  }
  for (const double far : {-3e7, 3e7}) append(soup, moved(cube(), {far, far, far}));
  return soup;
}

CleanSoup on_grid(const TriangleSoup& soup) {
  CleanReport report;
  CleanSoup clean = clean_surface(soup, report);
  internal::drop_cancelled(clean);
  return clean;
}

void expect_clean(const CleanSoup& soup) {
  std::set<std::array<PointId, 3>> all;
  for (const Triangle& t : soup.triangles) {
    std::array<PointId, 3> corners = t.corners;
    std::sort(corners.begin(), corners.end());
    EXPECT_TRUE(all.insert(corners).second) << "two triangles have the same corners";
    EXPECT_NE(t.winding, 0);
    EXPECT_GE(t.layers, 1);
    const auto& [a, b, c] = t.corners;
    Plane expected = plane_through(soup.grid_points[a], soup.grid_points[b], soup.grid_points[c]);
    const bool turned = make_canonical(expected);
    EXPECT_TRUE(same_coefficients(expected, soup.planes[t.plane]));
    EXPECT_EQ(t.winding, turned ? -1 : 1);
  }
}

TEST(ZipEdges, WhatWasClosedIsClosedOnTheGrid) {
  std::size_t open = 0;
  for (int seed = 0; seed < share_of_cases(300); ++seed) {
    SCOPED_TRACE(seed);
    const TriangleSoup soup = balls_of_few_steps(static_cast<unsigned>(seed));
    CleanSoup clean = on_grid(soup);
    open += unbalanced(clean).empty() ? 0 : 1;
    EXPECT_TRUE(internal::zip_edges(clean));
    EXPECT_TRUE(unbalanced(clean).empty());
    EXPECT_EQ(steps_in(clean), volume_on_grid(soup, clean.grid));
    expect_clean(clean);
    if (HasFailure()) return;
  }
  EXPECT_GT(open, expected_cases(std::size_t{200}));
}

TEST(ZipEdges, MissingTriangleLeavesTheSurfaceOpen) {
  for_each_seed(50, [&](std::uint64_t seed) {
    TriangleSoup soup = cube();
    soup.triangles.erase(soup.triangles.begin() + static_cast<std::ptrdiff_t>(seed % 12));
    CleanSoup clean = on_grid(soup);
    EXPECT_FALSE(internal::zip_edges(clean));
    EXPECT_EQ(unbalanced(clean).size(), 3u);
  });
}

TEST(ZipEdges, WhatIsClosedStaysAsItIs) {
  const TriangleSoup soup = sphere(2000);
  CleanSoup clean = on_grid(soup);
  const CleanSoup before = clean;
  EXPECT_TRUE(internal::zip_edges(clean));
  ASSERT_EQ(clean.triangles.size(), before.triangles.size());
  for (TriangleId t(0u); t.index() < clean.triangles.size(); ++t.value) {
    EXPECT_EQ(clean.triangles[t].corners, before.triangles[t].corners);
    EXPECT_EQ(clean.triangles[t].source, t.value);
  }
}

// A triangle that is a line on the grid, and the one beyond its whole side the reverse of one of
// its neighbours: cutting it at the corner makes copies, which cancel out.
TEST(ZipEdges, PiecesThatAreThereAlreadyCancelOut) {
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {4, 0, 0}, {8, 0, 0}, {0, 4, 0}, {0, 0, 4}};
  const std::uint32_t a = 0, middle = 1, b = 2, y = 3, z = 4;
  // Two tetrahedra over a, middle, y, z and middle, b, y, z, without the wall between them, their
  // lower faces made of one, whose cut has become a line.
  soup.triangles = {{a, b, z},      {a, middle, b}, {a, y, middle},
                    {middle, y, b}, {b, y, z},      {a, z, y}};
  for (const double far : {-3e7, 3e7}) append(soup, moved(cube(), {far, far, far}));
  CleanSoup clean = on_grid(soup);
  EXPECT_EQ(unbalanced(clean).size(), 3u);
  EXPECT_TRUE(internal::zip_edges(clean));
  EXPECT_TRUE(unbalanced(clean).empty());
  EXPECT_EQ(steps_in(clean), volume_on_grid(soup, clean.grid));
  expect_clean(clean);
}

// As before, but on the whole face stand tetrahedra that are there twice: of the copies more are
// turned the other way.
TEST(ZipEdges, PiecesAreTurnedAsMostCopiesAre) {
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {4, 0, 0}, {8, 0, 0}, {0, 4, 0}, {0, 0, 4}, {2, -4, 2}};
  const std::uint32_t a = 0, middle = 1, b = 2, y = 3, z = 4, top = 5;
  soup.triangles = {{a, b, z},      {a, middle, b}, {a, y, middle},
                    {middle, y, b}, {b, y, z},      {a, z, y}};
  for (const auto& [from, to] : {std::pair(a, middle), std::pair(middle, b)}) {
    for (int i = 0; i < 2; ++i) {
      soup.triangles.insert(soup.triangles.end(),
                            {{to, from, z}, {from, to, top}, {to, z, top}, {z, from, top}});
    }
  }
  for (const double far : {-3e7, 3e7}) append(soup, moved(cube(), {far, far, far}));
  CleanSoup clean = on_grid(soup);
  EXPECT_TRUE(internal::zip_edges(clean));
  EXPECT_TRUE(unbalanced(clean).empty());
  EXPECT_EQ(steps_in(clean), volume_on_grid(soup, clean.grid));
  expect_clean(clean);
}

// As before, but at the upper side, too: what is between is nothing.
TEST(ZipEdges, AFlatPocketVanishes) {
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {4, 0, 0}, {8, 0, 0}, {0, 4, 0}};
  soup.triangles = {{0, 2, 3}, {0, 1, 2}, {0, 3, 1}, {1, 3, 2}};
  for (const double far : {-3e7, 3e7}) append(soup, moved(cube(), {far, far, far}));
  CleanSoup clean = on_grid(soup);
  EXPECT_FALSE(unbalanced(clean).empty());
  EXPECT_TRUE(internal::zip_edges(clean));
  EXPECT_EQ(clean.triangles.size(), 24u);
  EXPECT_EQ(clean.points.size(), 16u);
}

// Flat tetrahedra with one side of three corners, all of these on one line and at one corner.
TEST(ZipEdges, ManyEdgesMayHaveManyCornersOfOneLine) {
  TriangleSoup soup;
  soup.points = {{0, 0, 0}};
  for (int i = 1; i <= 60; ++i) {
    const auto p = static_cast<std::uint32_t>(soup.points.size());
    soup.points.insert(soup.points.end(), {Vec3d(i, 0, 0), Vec3d(100 + i, 0, 0), Vec3d(0, i, 50)});
    const std::uint32_t q = p + 1, top = p + 2;
    const IndexTriangle faces[] = {{0, p, q}, {0, top, p}, {p, top, q}, {q, top, 0}};
    soup.triangles.insert(soup.triangles.end(), std::begin(faces), std::end(faces));
  }
  for (const double far : {-3e7, 3e7}) append(soup, moved(cube(), {far, far, far}));
  CleanSoup clean = on_grid(soup);
  EXPECT_EQ(unbalanced(clean).size(), 180u);
  EXPECT_TRUE(internal::zip_edges(clean));
  EXPECT_EQ(clean.triangles.size(), 24u);
}

TEST(CloseSurface, NeitherSewsNorPatches) {
  for (int seed = 0; seed < share_of_cases(50); ++seed) {
    SCOPED_TRACE(seed);
    RepairReport report;
    StageMeter meter(report.stages, nullptr);
    const CleanSoup clean = internal::close_surface(balls_of_few_steps(static_cast<unsigned>(seed)),
                                                    RepairOptions{}, report, meter);
    EXPECT_TRUE(unbalanced(clean).empty());
    EXPECT_EQ(report.holes.closed, 0u);
    EXPECT_EQ(report.sew.joined_points, 0u);
    EXPECT_EQ(report.input.triangles, clean.triangles.size());
  }
}

}  // namespace
}  // namespace meshrepair
