// SPDX-License-Identifier: MIT
// Complexes made by predicates that may be wrong: cells, cover and surface stay sound.
#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <extract/float_engine.h>

#include "cells/check_complex.h"
#include "complexes.h"
#include "degenerate_soups.h"
#include "each_seed.h"
#include "share_of_cases.h"
#include "surface/loose_regions.h"
#include "unreliable_engine.h"

namespace meshrepair {
namespace {

using namespace testing;

constexpr std::array kEpsilons = {0.0, 1e-15, kDefaultEpsilon, 1e-4, 1e-2};

struct Totals {
  ClipReport clip;
  std::size_t guessed = 0;
  std::size_t apart = 0;
  std::size_t merged = 0;
};

void add(Totals& totals, const ClipReport& clip) {
  totals.clip.loose_points += clip.loose_points;
  totals.clip.several_groups += clip.several_groups;
  totals.clip.region_floods += clip.region_floods;
  totals.clip.several_regions += clip.several_regions;
  totals.clip.forced_cuts += clip.forced_cuts;
}

void expect_finite(const CellComplex& complex) {
  for (const Point& p : complex.vertices) {
    for (const double x : p.position) ASSERT_LT(std::abs(x), 0x1p27);
  }
  for (CellId c(0u); c < complex.cells.end_id(); ++c.value) {
    ASSERT_TRUE(std::isfinite(cell_volume(complex, c)));
  }
}

void expect_surfaces(const CellComplex& complex, const IdVector<FacetId, Cover>& cover,
                     std::uint64_t seed, Totals& totals) {
  std::vector<char> random_cells(complex.cells.size());
  Random random(seed);
  for (char& c : random_cells) c = random.chance(0.3) ? 1 : 0;
  for (const std::vector<char>& solid : {enclosed_cells(complex, cover), random_cells}) {
    for (const Touching touching : {Touching::separate, Touching::join}) {
      ExtractReport report;
      ExtractOptions options;
      options.touching = touching;
      const Surface surface = extract_surface(complex, cover, solid, report, options);
      if (!surface.mesh.triangles.empty()) expect_closed_manifold(surface.mesh);
      EXPECT_EQ(surface.source.size(), surface.mesh.triangles.size());
      EXPECT_EQ(surface.input_point.size(), surface.mesh.points.size());
      for (const Vec3d& p : surface.mesh.points) ASSERT_TRUE(p.allFinite());
      totals.apart += report.polygons_apart;
      totals.merged += report.boundary_facets - report.regions;
    }
  }
}

void expect_sound(const TriangleSoup& soup, PredicateEngine* engine, std::uint64_t seed,
                  Totals& totals) {
  const Tree tree = tree_of(soup);
  BuildCellsOptions options;
  options.engine = engine;
  options.check_every_clip = true;
  ClipReport clip;
  CellComplex complex = build_cells(tree, options, clip);
  EXPECT_TRUE(complex.loose);
  EXPECT_EQ(complex.cells.size(), tree.leaves.size());
  ASSERT_NO_THROW(internal::check_complex(complex));
  CoverReport report;
  const auto cover = cover_facets(complex, own_windings(tree.input), report);
  ASSERT_NO_THROW(internal::check_complex(complex));
  expect_finite(complex);
  expect_surfaces(complex, cover, seed, totals);
  add(totals, clip);
  totals.guessed += report.guessed_facets;
}

class EverySoupInFloatingPoint : public ::testing::TestWithParam<SoupFamily> {};

TEST_P(EverySoupInFloatingPoint, GivesSoundCellsAndSurfaces) {
  Totals totals;
  for (const double epsilon : kEpsilons) {
    for_each_seed(400, 6, [&](std::uint64_t seed) {
      SCOPED_TRACE(std::to_string(seed) + ", eps " + std::to_string(epsilon));
      const TriangleSoup soup = GetParam().make(seed);
      CleanReport clean;
      FloatEngine engine(clean_soup(soup, clean), epsilon);
      expect_sound(soup, &engine, seed, totals);
    });
  }
  EXPECT_GE(totals.clip.loose_points, expected_cases(1u));
  EXPECT_GE(totals.merged, expected_cases(1u));
}

INSTANTIATE_TEST_SUITE_P(Families, EverySoupInFloatingPoint,
                         ::testing::ValuesIn(degenerate_families()),
                         [](const auto& param_info) { return param_info.param.name; });

// Each of the clipper's fallbacks is met with a tolerance that is far too large, on shapes too.
TEST(FloatEngine, EveryFallbackIsTakenSomewhere) {
  Totals totals;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {  // all: some are rare
    const TriangleSoup soup = seed % 2 == 0 ? noisy_sphere(150, 0.3, seed) : random_cubes(6, seed);
    CleanReport clean;
    FloatEngine engine(clean_soup(soup, clean), kEpsilons[seed % kEpsilons.size()]);
    expect_sound(soup, &engine, seed, totals);
  }
  EXPECT_GT(totals.clip.several_groups, 0u);
  EXPECT_GT(totals.clip.region_floods, 0u);
  EXPECT_GT(totals.clip.several_regions, 0u);
  EXPECT_GT(totals.clip.forced_cuts, 0u);
  EXPECT_GT(totals.apart, 0u);
}

TEST(LooseComplex, AnswersAtRandomGiveSoundCellsAndSurfaces) {
  Totals totals;
  for (std::uint64_t seed = 0; seed < share_of_cases(60u); ++seed) {
    SCOPED_TRACE(seed);
    const TriangleSoup soup = seed % 3 == 0   ? random_soup(25, 5, seed)
                              : seed % 3 == 1 ? sphere(60)
                                              : coplanar_soup(20, seed);
    UnreliableEngine engine(seed, seed % 4 == 0 ? 0.02 : seed % 4 == 1 ? 0.3 : 1.0);
    expect_sound(soup, &engine, seed, totals);
  }
  EXPECT_GT(totals.clip.several_groups, 0u);
  EXPECT_GT(totals.apart, 0u);
}

Surface enclosed_surface(const TriangleSoup& soup, ClipReport& clip, ExtractReport& report) {
  const Tree tree = tree_of(soup);
  FloatEngine engine(tree.input, kDefaultEpsilon);
  BuildCellsOptions options;
  options.engine = &engine;
  CellComplex complex = build_cells(tree, options, clip);
  CoverReport covered;
  const auto cover = cover_facets(complex, own_windings(tree.input), covered);
  return extract_surface(complex, cover, enclosed_cells(complex, cover), report);
}

// Where no plane passes near a vertex that is not on it, nothing goes wrong.
TEST(LooseComplex, MeshesOfFewPlanesComeOutBitForBit) {
  for (const TriangleSoup& soup : {cube(), moved(cube(), {1e3, 2e-3, 0.1}), cone(7)}) {
    ClipReport clip;
    ExtractReport report;
    const Surface surface = enclosed_surface(soup, clip, report);
    EXPECT_EQ(clip.several_groups + clip.region_floods, 0u);
    EXPECT_EQ(surface.mesh.triangles.size(), soup.triangles.size());
    EXPECT_EQ(report.polygons_apart, 0u);
    for (const Vec3d& p : surface.mesh.points) {
      EXPECT_NE(std::find(soup.points.begin(), soup.points.end(), p), soup.points.end());
    }
  }
}

TEST(LooseRegions, StraightIsNearTheLineAndBetweenItsEnds) {
  const Point a = loose_point({0, 0, 0});
  const Point b = loose_point({10, 0, 0});
  EXPECT_TRUE(internal::lies_between(loose_point({5, 0.09, 0}, 0.1), a, b));
  EXPECT_FALSE(internal::lies_between(loose_point({5, 0.11, 0}, 0.1), a, b));
  EXPECT_FALSE(internal::lies_between(loose_point({11, 0, 0}, 0.1), a, b));
  EXPECT_FALSE(internal::lies_between(loose_point({-1, 0, 0}, 0.1), a, b));
  EXPECT_FALSE(internal::lies_between(loose_point({0, 0, 0}, 0.1), a, a));
}

TEST(LooseRegions, ConflictsAreFoundByEdges) {
  using Triangles = std::vector<std::array<std::uint32_t, 3>>;
  const Triangles sound = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
  const std::vector<std::uint32_t> regions = {7, 8, 9, 9};
  const auto conflicts = [&](const Triangles& triangles) {
    return internal::conflicting_regions(triangles, {regions.data(), triangles.size()});
  };
  EXPECT_TRUE(conflicts(sound).empty());
  Triangles open = sound;
  open.pop_back();
  EXPECT_EQ(conflicts(open), (std::vector<std::uint32_t>{7, 8, 9}));
  Triangles turned = sound;
  std::swap(turned[0][0], turned[0][1]);
  EXPECT_EQ(conflicts(turned), (std::vector<std::uint32_t>{7, 8, 9}));
  const Triangles folded = {{0, 1, 1}, {0, 1, 2}};
  EXPECT_EQ(conflicts(folded), (std::vector<std::uint32_t>{7, 8}));
}

}  // namespace
}  // namespace meshrepair
