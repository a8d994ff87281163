// SPDX-License-Identifier: MIT
// Closed surfaces, however they cross: what comes out without cells is what cells would have given.
#include "arrange/chamber_surface.h"

#include <cmath>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <check/check_surface.h>
#include <extract/arrange.h>
#include <repair/repair.h>

#include "degenerate_soups.h"
#include "graphs.h"
#include "prepare/prepare.h"
#include "random_solids.h"
#include "shapes.h"
#include "share_of_cases.h"
#include "surface/make_surface.h"

namespace meshrepair {
namespace {

using namespace testing;

// By chambers, if that way applies.
std::optional<RepairResult> repair_by_chambers(const TriangleSoup& soup, RepairOptions options) {
  RepairReport report;
  std::optional<Surface> surface;
  {
    StageMeter meter(report.stages, options.progress);
    const CleanSoup clean = internal::close_soup(soup, options, report, meter);
    const Orientation orientation = internal::orient_soup(clean, options, report, meter);
    internal::SavedStates states;
    surface = internal::surface_by_chambers(clean, orientation, options, states, report, meter);
  }
  if (!surface) return std::nullopt;
  return RepairResult{std::move(*surface), std::move(report)};
}

void expect_same(const RepairReport& a, const RepairReport& b) {
  EXPECT_EQ(a.inside.used, b.inside.used);
  EXPECT_EQ(a.inside.reason, b.inside.reason);
  EXPECT_EQ(a.inside.turned_parts, b.inside.turned_parts);
  EXPECT_EQ(a.inside.cavity_walls, b.inside.cavity_walls);
  EXPECT_EQ(a.inside.left_out_folds, b.inside.left_out_folds);
  EXPECT_EQ(a.parts.bounding_triangles, b.parts.bounding_triangles);
  EXPECT_EQ(a.parts.inside_triangles, b.parts.inside_triangles);
  EXPECT_EQ(a.parts.inside_solid.parts, b.parts.inside_solid.parts);
  EXPECT_EQ(a.output.parts, b.output.parts);
  EXPECT_LE(a.output.triangles, b.output.triangles + b.output.triangles / 20);
  EXPECT_GE(a.triangles.untouched, b.triangles.untouched);
  EXPECT_NEAR(a.output_volume, b.output_volume, 1e-9 * std::abs(b.output_volume));
  EXPECT_NEAR(a.output_area, b.output_area, 1e-9 * b.output_area);
}

// Whether it applies; then the result is that of all cells.
bool is_as_from_cells(const TriangleSoup& soup, RepairOptions options = {}) {
  options.simplify = 0;  // the same triangles are cut, but not into the same pieces
  std::optional<RepairResult> without;
  try {
    without = repair_by_chambers(soup, options);
  } catch (const NoSolidError&) {
    return false;
  }
  if (!without) return false;
  EXPECT_TRUE(without->report.certify.passed());
  EXPECT_TRUE(check_surface(without->surface.mesh).valid_solid());
  EXPECT_EQ(without->report.cells, 0u);
  options.all_cells = true;
  const RepairResult whole = repair(soup, options);
  // Where points were moved, or slits filled, a few last bits are another surface.
  const bool moved = whole.report.certify.pairs_at_first > 0 ||
                     without->report.certify.pairs_at_first > 0 ||
                     whole.report.thin_cells.filled + whole.report.thin_cells.emptied > 0;
  if (!moved) expect_same(without->report, whole.report);
  EXPECT_NEAR(without->report.output_volume, whole.report.output_volume,
              1e-5 * std::abs(whole.report.output_volume));
  return true;
}

struct Scenes {
  const char* name;
  std::uint64_t cases;
  std::uint64_t least;  // of these, in which the way applies: others are left to cells
  TriangleSoup (*make)(std::uint64_t seed);
};

class ClosedScenes : public ::testing::TestWithParam<Scenes> {};

TEST_P(ClosedScenes, ComeOutAsFromCells) {
  std::uint64_t applied = 0;
  const std::uint64_t cases = share_of_cases(GetParam().cases);
  for (std::uint64_t seed = 1; seed <= cases; ++seed) {
    SCOPED_TRACE(seed);
    RepairOptions options;
    const InsideRule rules[] = {InsideRule::automatic, InsideRule::automatic, InsideRule::winding,
                                InsideRule::parity};
    options.inside.rule = rules[seed % 4];
    if (seed % 5 == 0) options.extract.touching = Touching::join;
    applied += is_as_from_cells(GetParam().make(seed), options) ? 1 : 0;
  }
  EXPECT_GE(applied, expected_cases(GetParam().least));
}

TriangleSoup copies_of_boxes(std::uint64_t seed) {
  return with_copies(random_grid_boxes(2 + seed % 6, 4, seed), 0.4, seed);
}

TriangleSoup turned_boxes(std::uint64_t seed) {
  Random random(seed);
  return transformed(random_grid_boxes(2 + seed % 8, 5, seed), random_rotation(random));
}

TriangleSoup shells_in_shells(std::uint64_t seed) {
  Random random(seed);
  TriangleSoup soup;
  for (int i = random.integer(2, 6); i > 0; --i) {
    TriangleSoup shell = sphere(80, random.real(0.2, 3));
    if (random.chance(0.4)) shell = flipped(std::move(shell));
    const double wide = random.chance(0.5) ? 0.0 : 2.0;
    append(soup, moved(std::move(shell), {random.real(-wide, wide), random.real(-wide, wide), 0}));
  }
  return soup;
}

TriangleSoup pair_of_solids(std::uint64_t seed) {
  std::vector<TriangleSoup> pair = random_pair(seed);
  append(pair[0], pair[1]);
  return pair[0];
}

INSTANTIATE_TEST_SUITE_P(
    Chambers, ClosedScenes,
    ::testing::Values(Scenes{"GridBoxes", 200, 140,
                             [](std::uint64_t s) { return random_grid_boxes(2 + s % 8, 5, s); }},
                      Scenes{"Tetrahedra", 200, 140,
                             [](std::uint64_t s) { return tetrahedra_soup(2 + s % 8, s); }},
                      Scenes{"CopiesOfBoxes", 100, 40, copies_of_boxes},
                      Scenes{"TurnedBoxes", 60, 8, turned_boxes},
                      Scenes{"Cubes", 60, 50,
                             [](std::uint64_t s) { return random_cubes(2 + s % 12, s); }},
                      Scenes{"NoisySpheres", 30, 25,
                             [](std::uint64_t s) {
                               return noisy_sphere(200, 0.05 * static_cast<double>(1 + s % 5), s);
                             }},
                      Scenes{"ShellsInShells", 60, 50, shells_in_shells},
                      Scenes{"PairsOfSolids", 60, 40, pair_of_solids}),
    [](const auto& scene) { return scene.param.name; });

// With one more triangle on an edge of the sphere, so wide beside it.
TriangleSoup sphere_with_fin(double width) {
  TriangleSoup soup = sphere(2000, 1);
  const IndexTriangle c = soup.triangles[0];
  const Vec3d middle = 0.5 * (soup.points[c[0]] + soup.points[c[1]]);
  soup.triangles.push_back({c[0], c[1], static_cast<std::uint32_t>(soup.points.size())});
  soup.points.push_back((1 + width) * middle);
  return soup;
}

TEST(ChamberSurface, LooseSheetsThatAreLittleOfTheSurfaceAreNoReasonForCells) {
  RepairOptions options;
  options.holes.mode = HoleMode::none;
  EXPECT_TRUE(is_as_from_cells(sphere_with_fin(0.1), options));
  EXPECT_FALSE(is_as_from_cells(sphere_with_fin(2), options));
}

// A triangle is turned; of two more, one lies on the box, the other cuts through it, from edge to
// edge.
TEST(ChamberSurface, TrianglesThatContradictEachOtherAreLeftToCells) {
  TriangleSoup boxes = box({2, 2, 0}, {6, 3, 3});
  std::swap(boxes.triangles[7][1], boxes.triangles[7][2]);
  append(boxes, box({3, 2, 2}, {2, 3, 3}));
  boxes.triangles.push_back({10, 6, 3});
  boxes.triangles.push_back({5, 3, 0});
  RepairOptions options;
  options.inside.rule = InsideRule::winding;
  options.inside.cavities = Cavities::fill;
  options.holes.mode = HoleMode::extend;
  options.sew.mode = SewMode::none;
  EXPECT_FALSE(repair_by_chambers(boxes, options));
}

TEST(ChamberSurface, AVesselWithoutItsLidIsLeftToCells) {
  TriangleSoup vessel = box({0, 0, 0}, {1, 1, 1});
  vessel.triangles.resize(10);
  append(vessel, box({2, 0, 0}, {3, 1, 1}));
  RepairOptions options;
  options.holes.mode = HoleMode::none;
  EXPECT_FALSE(is_as_from_cells(vessel, options));
}

// Unit cubes of a lattice of 3 x 3 x 3; bit x + 3 y + 9 z of the mask says whether there is one.
TriangleSoup lattice_cubes(std::uint32_t mask) {
  TriangleSoup soup;
  for (int k = 0; k < 27; ++k) {
    const Vec3d low(k % 3, k / 3 % 3, k / 9);
    if ((mask >> k & 1) != 0) append(soup, box(low, low + Vec3d(1, 1, 1)));
  }
  return soup;
}

// Two cubes touch along an edge; slabs above and below, each with a notch, join them round both of
// its ends.
TEST(ChamberSurface, AnEdgeWithBothEndsInOneFanGetsMiddles) {
  const std::uint32_t slab = 0b011'001;  // of four places three
  const TriangleSoup soup = lattice_cubes(slab | 0b010'001 << 9 | slab << 18);
  const auto result = repair_by_chambers(soup, {});
  ASSERT_TRUE(result);
  EXPECT_EQ(result->report.output.parts, 1u);
  EXPECT_EQ(result->report.arrange.middle_vertices, 2u);
  EXPECT_TRUE(is_as_from_cells(soup));
  // The sum of two points is beyond the numbers there.
  const auto large = repair_by_chambers(scaled(moved(soup, {1, 1, 0}), 0x1p1022), {});
  ASSERT_TRUE(large);
  EXPECT_EQ(large->report.arrange.middle_vertices, 2u);
  for (const Vec3d& p : large->surface.mesh.points) EXPECT_TRUE(p.allFinite());
}

TEST(ChamberSurface, CubesOfALatticeComeOutAsFromCells) {
  const std::uint64_t cases = share_of_cases(150u);
  for (std::uint64_t seed = 1; seed <= cases; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    std::uint32_t mask = 1;
    for (int k = 1; k < 27; ++k) mask |= random.chance(0.5) ? 1u << k : 0;
    RepairOptions options;
    options.inside.rule = InsideRule::winding;
    if (seed % 3 == 0) options.extract.touching = Touching::join;
    EXPECT_TRUE(is_as_from_cells(lattice_cubes(mask), options));
  }
}

CellId root_of(std::vector<CellId>& up, CellId c) {
  while (up[c.index()] != c) c = up[c.index()] = up[up[c.index()].index()];
  return c;
}

// The regions that cells make up through facets that no triangle covers.
std::size_t regions_of(const CellGraph& graph) {
  std::vector<CellId> up;
  for (CellId c(0u); c.index() < graph.cells(); ++c.value) up.push_back(c);
  CellId outside;
  const auto join = [&](CellId a, CellId b) { up[root_of(up, a).index()] = root_of(up, b); };
  for (CellId c(0u); c.index() < graph.cells(); ++c.value) {
    if (!graph.unbounded(c)) continue;
    if (outside.valid()) join(c, outside);
    outside = c;
  }
  for (const Link& link : graph.links()) {
    if (!link.opaque()) join(link.below, link.above);
  }
  std::size_t regions = 0;
  for (CellId c(0u); c.index() < graph.cells(); ++c.value) regions += root_of(up, c) == c;
  return regions;
}

class DegenerateSoups : public ::testing::TestWithParam<SoupFamily> {};

// Open, closed, folded, in one place: every soup divides space into regions.
TEST_P(DegenerateSoups, ChambersAreTheRegionsOfTheCells) {
  std::size_t made = 0;
  const std::uint64_t cases = share_of_cases(40u);
  for (std::uint64_t seed = 0; seed < cases; ++seed) {
    SCOPED_TRACE(seed);
    const Graph g = graph_of(GetParam().make(seed));
    const CleanSoup& soup = g.cells.complex.soup();
    ArrangeReport report;
    const std::optional<Arrangement> arrangement = Arrangement::make(soup, report);
    if (!arrangement) continue;
    ++made;
    std::set<std::uint32_t> chambers = {Arrangement::kOutside};
    std::vector<double> area(soup.triangles.size(), 0);
    for (const ChamberWall& wall : arrangement->walls()) {
      chambers.insert(wall.below);
      chambers.insert(wall.above);
      area[wall.triangle] += wall.area;
    }
    EXPECT_EQ(chambers.size(), regions_of(g.graph));
    for (TriangleId t(0u); t < soup.triangles.end_id(); ++t.value) {
      const double unit = soup.grid.unit;
      const double whole = area_of(soup, soup.triangles[t]);
      EXPECT_LE(area[t.index()] * unit * unit, whole * (1 + 1e-6) + 1e-6 * unit * unit);
    }
  }
  EXPECT_GE(made, cases * 3 / 4);
}

INSTANTIATE_TEST_SUITE_P(Chambers, DegenerateSoups, ::testing::ValuesIn(degenerate_families()),
                         [](const auto& family) { return family.param.name; });

}  // namespace
}  // namespace meshrepair
