// SPDX-License-Identifier: MIT
// Meshes that are solids once cleaned, closed and turned: no cells are made of them, and what comes
// out is what the cells would have given.
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <repair/repair.h>

#include "degenerate_soups.h"
#include "each_seed.h"
#include "open_surfaces.h"
#include "random_solids.h"
#include "shapes.h"
#include "share_of_cases.h"
#include "triangles_by_place.h"

namespace meshrepair {
namespace {

using namespace testing;

// The triangles with their sources.
std::vector<std::pair<PlacedTriangle, std::uint32_t>> contents(const Surface& surface) {
  std::vector<std::pair<PlacedTriangle, std::uint32_t>> all;
  for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t) {
    all.emplace_back(placed_triangle(surface.mesh, t), surface.source[t]);
  }
  std::sort(all.begin(), all.end());
  return all;
}

void expect_same(const RepairResult& spared, const RepairResult& whole) {
  EXPECT_EQ(contents(spared.surface), contents(whole.surface));
  const RepairReport& a = spared.report;
  const RepairReport& b = whole.report;
  EXPECT_TRUE(a.certify.passed());
  EXPECT_EQ(a.inside.used, b.inside.used);
  EXPECT_EQ(a.inside.turned_parts, b.inside.turned_parts);
  EXPECT_EQ(a.inside.cavity_walls, b.inside.cavity_walls);
  EXPECT_EQ(a.inside.doubtful_parts, b.inside.doubtful_parts);
  EXPECT_EQ(a.orient.turned_triangles, b.orient.turned_triangles);
  EXPECT_EQ(a.holes.triangles, b.holes.triangles);
  EXPECT_EQ(a.triangles.untouched, b.triangles.untouched);
  EXPECT_EQ(a.triangles.cut, b.triangles.cut);
  EXPECT_EQ(a.parts.bounding_triangles, b.parts.bounding_triangles);
  EXPECT_EQ(a.output.parts, b.output.parts);
  EXPECT_NEAR(a.output_volume, b.output_volume, 1e-12 * std::abs(b.output_volume));
  EXPECT_NEAR(a.closing_area, b.closing_area, 1e-12 * b.output_area);
}

// Whether cells were spared; then the result is that of the whole work.
bool spares_cells(const TriangleSoup& soup, RepairOptions options) {
  RepairResult spared;
  try {
    spared = repair(soup, options);
  } catch (const NoSolidError&) {
    return false;
  }
  if (!spared.report.spared_cells) return false;
  options.all_cells = true;
  expect_same(spared, repair(soup, options));
  return true;
}

// Balls in each other, each facing any way, and one beside them.
TriangleSoup nested_balls(Random& random) {
  TriangleSoup soup;
  double radius = 1;
  for (int depth = random.integer(1, 3); depth > 0; --depth, radius *= 0.7) {
    const TriangleSoup ball = sphere(200, radius);
    append(soup, random.chance(0.5) ? flipped(ball) : ball);
  }
  if (random.chance(0.4)) {
    const TriangleSoup ball = sphere(100, 1, {5, 0, 0});
    append(soup, random.chance(0.5) ? flipped(ball) : ball);
  }
  return soup;
}

TriangleSoup damaged(TriangleSoup soup, Random& random, std::uint64_t seed) {
  constexpr std::array kFlipped = {0.0, 0.1, 0.5};
  constexpr std::array kMissing = {0.0, 0.02};
  constexpr std::array kCopied = {0.0, 0.1};
  soup = with_some_flipped(soup, kFlipped[static_cast<std::size_t>(random.integer(0, 2))], seed);
  soup = without_some(soup, kMissing[static_cast<std::size_t>(random.integer(0, 1))], seed);
  return with_copies(soup, kCopied[static_cast<std::size_t>(random.integer(0, 1))], seed);
}

TEST(KeepValid, DamagedBallsComeOutAsFromCells) {
  std::size_t spared = 0;
  for (std::uint64_t seed = 1; seed <= share_of_cases(150u); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const TriangleSoup soup = damaged(nested_balls(random), random, seed);
    RepairOptions options;
    if (random.chance(0.3)) options.inside.rule = InsideRule::winding;
    if (random.chance(0.2)) options.inside.rule = InsideRule::parity;
    spared += spares_cells(soup, options);
  }
  EXPECT_GT(spared, expected_cases(40u));
}

TEST(KeepValid, DamagedSolidsComeOutAsFromCells) {
  std::size_t spared = 0;
  for_each_seed(1, 60, [&](std::uint64_t seed) {
    Random random(seed);
    spared += spares_cells(damaged(random_solid(random), random, seed), {});
  });
  for (const OpenSurface& open : open_surfaces()) {
    SCOPED_TRACE(open.name);
    spared += spares_cells(open.soup, {});
  }
  EXPECT_GT(spared, expected_cases(20u));
}

// A face that is there once as it should be and twice the other way round counts as the latter.
TEST(KeepValid, CopiesThatOutvoteTheFirstAreAsFromCells) {
  TriangleSoup soup = cube();
  for (int i = 0; i < 2; ++i)
    soup.triangles.push_back({soup.triangles[0][1], soup.triangles[0][0], soup.triangles[0][2]});
  EXPECT_TRUE(spares_cells(soup, {}));
  std::size_t spared = 0;
  for (std::uint64_t seed = 1; seed <= share_of_cases(60u); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    TriangleSoup ball = with_some_flipped(nested_balls(random), 0.3, seed);
    for (const std::uint64_t more : {1u, 2u, 3u}) ball = with_copies(ball, 0.3, seed + more);
    spared += spares_cells(ball, {});
  }
  EXPECT_GT(spared, expected_cases(20u));
}

TEST(KeepValid, SparesCellsWhereHolesAndTurnsAreAll) {
  TriangleSoup soup = torus(40, 20);
  soup = without_some(with_some_flipped(soup, 0.2, 3), 0.05, 3);
  const RepairResult result = repair(soup);
  EXPECT_TRUE(result.report.spared_cells);
  EXPECT_FALSE(result.report.kept_valid);
  EXPECT_EQ(result.report.cells, 0u);
  EXPECT_EQ(result.report.triangles.untouched, soup.triangles.size());
  EXPECT_GT(result.report.holes.closed, 0u);
  EXPECT_GT(result.report.orient.turned_triangles, 0u);
}

TEST(KeepValid, CutsTrianglesWhereSheetsCross) {
  TriangleSoup soup = two_overlapping_spheres(400);
  std::swap(soup.triangles[7][0], soup.triangles[7][1]);
  const RepairResult result = repair(soup);
  EXPECT_FALSE(result.report.spared_cells);
  EXPECT_GT(result.report.arrange.cut_triangles, 0u);
}

// What is inside out, alone or as a whole, is turned; of nested parts that contradict each other
// the cells tell.
TEST(KeepValid, TurnsPartsAsTheRuleDoes) {
  const TriangleSoup outer = box({0, 0, 0}, {9, 9, 9}), inner = box({1, 1, 1}, {8, 8, 8});
  const auto both = [](TriangleSoup a, const TriangleSoup& b) {
    append(a, b);
    return a;
  };
  EXPECT_TRUE(spares_cells(flipped(outer), {}));
  EXPECT_TRUE(spares_cells(both(flipped(outer), inner), {}));
  EXPECT_TRUE(spares_cells(both(flipped(outer), moved(inner, {20, 0, 0})), {}));
  EXPECT_FALSE(spares_cells(both(outer, inner), {}));
  EXPECT_FALSE(spares_cells(both(flipped(outer), flipped(inner)), {}));
  RepairOptions as_given;
  as_given.inside.rule = InsideRule::winding;
  EXPECT_FALSE(spares_cells(flipped(outer), as_given));
}

TEST(KeepValid, GivesWayToWhatOnlyCellsTell) {
  const TriangleSoup soup = without_some(sphere(300), 0.05, 1);
  ASSERT_TRUE(spares_cells(soup, {}));
  RepairOptions options;
  options.opacity.assign(soup.triangles.size(), 0.5f);
  EXPECT_TRUE(spares_cells(soup, options));  // it tells nothing where winding numbers do
  options = {};
  options.inside.rule = InsideRule::solidity;
  EXPECT_FALSE(spares_cells(soup, options));
  options = {};
  options.predicates = Predicates::floating;
  EXPECT_FALSE(spares_cells(soup, options));
}

// As the cells would, with the triangles that were given.
TEST(KeepValid, FillsVoidsByLeavingTheirWallsOut) {
  TriangleSoup soup = without_some(sphere(300), 0.05, 1);
  append(soup, flipped(moved(box({0, 0, 0}, {0.2, 0.2, 0.2}), {-0.1, -0.1, -0.1})));
  append(soup, box({-0.05, -0.05, -0.05}, {0.05, 0.05, 0.05}));
  RepairOptions options;
  options.inside.cavities = Cavities::fill;
  const RepairResult result = repair(soup, options);
  EXPECT_TRUE(result.report.spared_cells);
  EXPECT_EQ(result.report.output.parts, 1u);
  EXPECT_EQ(result.report.inside.filled_voids, 1u);
  options.all_cells = true;
  const RepairResult by_cells = repair(soup, options);
  EXPECT_EQ(by_cells.report.inside.filled_voids, 1u);
  EXPECT_EQ(contents(result.surface), contents(by_cells.surface));
}

// A triangle and the two halves of it: closed by a third one that has hardly any area, and nothing
// that the grid could tell.
TEST(KeepValid, MakesCellsOfSheetsThinnerThanTheGrid) {
  for_each_seed(1, 40, [&](std::uint64_t seed) {
    Random random(seed);
    const auto corner = [&] {
      return Vec3d(3 + random.real(0, 1), random.real(0, 1), random.real(0, 1));
    };
    const Vec3d a = corner(), b = corner(), c = corner();
    const Vec3d middle = (a + b) / 2;
    TriangleSoup soup = cube();
    add_triangle(soup, a, b, c);
    add_triangle(soup, a, middle, c);
    add_triangle(soup, middle, b, c);
    EXPECT_FALSE(spares_cells(soup, {}));
  });
}

TEST(KeepValid, IsExaminedLikeAnyResult) {
  std::vector<std::size_t> triangles;
  RepairOptions options = RepairOptions();
  options.examine = [&](const RepairReport& report) {
    triangles.push_back(report.output.triangles);
  };
  (void)repair(cube(), options);
  (void)repair(flipped(cube()), options);
  EXPECT_EQ(triangles, (std::vector<std::size_t>{12, 12}));
}

}  // namespace
}  // namespace meshrepair
