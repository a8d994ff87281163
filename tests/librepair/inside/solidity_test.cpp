// SPDX-License-Identifier: MIT
#include <string>

#include <gtest/gtest.h>

#include <base/parallel.h>
#include <repair/solidity.h>

#include "degenerate_soups.h"
#include "graphs.h"

namespace meshrepair {
namespace {

using namespace testing;

SolveOptions precise() {
  SolveOptions options;
  options.tolerance = 1e-12;
  return options;
}

// The bounded cell that holds a place.
CellId cell_at(const Graph& g, const Vec3d& at) {
  CellId best;
  double nearest = 1e300;
  for (CellId c(0u); c < g.cells.complex.cells.end_id(); ++c.value) {
    const double d = (cell_centre(g.cells.complex, c) - at).norm();
    if (d < nearest) {
      nearest = d;
      best = c;
    }
  }
  return best;
}

double solidity_energy(const CellGraph& graph, const std::vector<double>& s) {
  double sum = 0;
  for (const Link& link : graph.links()) {
    const double a = s[link.below.index()];
    const double b = s[link.above.index()];
    sum += link.area * (link.opaque() ? (a + b) * (a + b) : (a - b) * (a - b));
  }
  return sum;
}

double winding_energy(const CellGraph& graph, const std::vector<double>& w) {
  double sum = 0;
  for (const Link& link : graph.links()) {
    const double d = w[link.below.index()] - w[link.above.index()] - link.winding;
    sum += link.area * d * d;
  }
  return sum;
}

TEST(Solidity, AWholeCubeIsSolidForCertain) {
  const Graph g = graph_of(cube());
  SolveReport report;
  const auto s = solve_solidity(g.graph, precise(), report);
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.unknowns, 1u);
  EXPECT_NEAR(s[cell_at(g, {0.5, 0.5, 0.5}).index()], 1, 1e-9);
}

// One unknown: s = (opaque - transparent) / (opaque + transparent), w = opaque / all.
TEST(Solidity, ACubeWithOpeningsMatchesTheClosedForm) {
  for (std::size_t missing = 0; missing <= 11; ++missing) {
    SCOPED_TRACE(missing);
    TriangleSoup soup = cube();
    soup.triangles.resize(12 - missing);
    soup.points.push_back({0.5, 0.5, 0.5});
    const Graph g = graph_of(soup);
    const auto inside = cell_at(g, {0.5, 0.5, 0.5}).index();
    if (g.graph.unbounded(CellId(inside))) continue;  // too little is left to bound it
    double opaque = 0, all = 0;
    for (const std::uint32_t l : g.graph.links_of(CellId(inside))) {
      const Link& link = g.graph.links()[l];
      all += link.area;
      if (link.opaque()) opaque += link.area;
    }
    SolveReport report;
    const auto s = solve_solidity(g.graph, precise(), report);
    if (report.unknowns != 1) continue;
    EXPECT_NEAR(s[inside], (2 * opaque - all) / all, 1e-9);
    EXPECT_NEAR(opaque / all, static_cast<double>(12 - missing) / 12, 1e-9);
    EXPECT_NEAR(solve_winding(g.graph, precise(), report)[inside], opaque / all, 1e-9);
  }
}

// Two unit cubes side by side, the wall between them opaque or not, one far end open.
TEST(Solidity, TwoCellsMatchTheClosedForm) {
  TriangleSoup soup = box({0, 0, 0}, {1, 1, 1});
  append(soup, box({1, 0, 0}, {2, 1, 1}));
  // Of the second box the side x = 2 is left out, triangles 14 and 15; the wall is there twice.
  soup.triangles.erase(soup.triangles.begin() + 14, soup.triangles.begin() + 16);
  const Graph g = graph_of(soup);
  const auto a = cell_at(g, {0.5, 0.5, 0.5}).index();
  const auto b = cell_at(g, {1.5, 0.5, 0.5}).index();
  SolveReport report;
  const auto s = solve_solidity(g.graph, precise(), report);
  ASSERT_EQ(report.unknowns, 2u);
  // a: 6 a = 5 - b.   b: 6 b = 4 - 1 - a.
  EXPECT_NEAR(s[a], 27.0 / 35, 1e-9);
  EXPECT_NEAR(s[b], 13.0 / 35, 1e-9);
  // The wall's two windings cancel. a: 6 w_a = 5 + w_b.   b: 6 w_b = 4 + w_a.
  const auto w = solve_winding(g.graph, precise(), report);
  EXPECT_NEAR(w[a], 34.0 / 35, 1e-9);
  EXPECT_NEAR(w[b], 29.0 / 35, 1e-9);
}

// A cube of one cell, of which the first triangles, one side, are not sure.
TEST(Solidity, HalfOpaqueSidesAreBetweenOpaqueAndOpenOnes) {
  for (const float opacity : {0.25f, 0.5f, 1.0f}) {
    Graph g = graph_of(cube());
    IdVector<TriangleId, float> opacities;
    opacities.resize(12);
    for (TriangleId t(0u); t.index() < 12; ++t.value) opacities[t] = t.index() < 2 ? opacity : 1;
    g.graph.set_opacities(opacities);
    SolveReport report;
    const auto s = solve_solidity(g.graph, precise(), report);
    EXPECT_NEAR(s[cell_at(g, {0.5, 0.5, 0.5}).index()], (2.0 + opacity) / 3, 1e-9);
  }
}

TEST(Solidity, EnergyIsMinimal) {
  for (const SoupFamily& family : degenerate_families()) {
    SCOPED_TRACE(family.name);
    const Graph g = graph_of(family.make(1));
    SolveReport report;
    const auto s = solve_solidity(g.graph, precise(), report);
    const auto w = solve_winding(g.graph, precise(), report);
    const double energy_s = solidity_energy(g.graph, s);
    const double energy_w = winding_energy(g.graph, w);
    Random random(1);
    for (int i = 0; i < 50; ++i) {
      auto other_s = s;
      auto other_w = w;
      const double step = random.chance(0.5) ? 0.3 : 0.01;
      const bool one = random.chance(0.5);
      const auto picked = static_cast<std::size_t>(
          random.integer(0, static_cast<std::int32_t>(g.graph.cells()) - 1));
      for (std::size_t c = 0; c < g.graph.cells(); ++c) {
        if (g.graph.unbounded(CellId(c)) || (one && c != picked)) continue;
        other_s[c] += random.real(-step, step);
        other_w[c] += random.real(-step, step);
      }
      EXPECT_GE(solidity_energy(g.graph, other_s), energy_s * (1 - 1e-7));
      EXPECT_GE(winding_energy(g.graph, other_w), energy_w * (1 - 1e-7));
    }
  }
}

TEST(Solidity, ValuesAreWithinOneAndOutsideIsFixed) {
  for (const SoupFamily& family : degenerate_families()) {
    SCOPED_TRACE(family.name);
    const Graph g = graph_of(family.make(2));
    SolveReport report;
    const auto s = solve_solidity(g.graph, {}, report);
    const auto w = solve_winding(g.graph, {}, report);
    EXPECT_TRUE(report.converged);
    for (CellId c(0u); c.index() < g.graph.cells(); ++c.value) {
      EXPECT_LE(std::abs(s[c.index()]), 1);
      if (!g.graph.unbounded(c)) continue;
      EXPECT_EQ(s[c.index()], -1);
      EXPECT_EQ(w[c.index()], 0);
    }
  }
}

TEST(Solidity, OrientationDoesNotMatter) {
  const TriangleSoup soup = without_some(two_overlapping_spheres(400), 0.1, 1);
  const Graph g = graph_of(soup);
  const Graph turned = graph_of(with_some_flipped(soup, 0.5, 2));
  SolveReport report;
  EXPECT_EQ(solve_solidity(g.graph, {}, report), solve_solidity(turned.graph, {}, report));
}

TEST(Solidity, AStartNearTheOptimumIsDoneSooner) {
  const Graph g = graph_of(without_some(two_overlapping_spheres(400), 0.02, 1));
  SolveReport from_zero, from_near, from_far;
  const auto s = solve_solidity(g.graph, precise(), from_zero);
  std::vector<double> near = s;
  std::vector<double> far = s;
  for (std::size_t c = 0; c < s.size(); ++c) {
    near[c] += c % 2 == 0 ? 1e-3 : -1e-3;
    far[c] = -10 * s[c];
  }
  const auto from_near_on = solve_solidity(g.graph, precise(), from_near, near);
  EXPECT_LT(from_near.iterations, from_zero.iterations);
  EXPECT_TRUE(from_near.converged);
  for (std::size_t c = 0; c < s.size(); ++c) EXPECT_NEAR(from_near_on[c], s[c], 1e-8);
  EXPECT_EQ(solve_solidity(g.graph, precise(), from_far, far), s);
  EXPECT_EQ(from_far.iterations, from_zero.iterations);
}

// More unknowns than one task has.
TEST(Solidity, TheNumberOfThreadsDoesNotMatter) {
  const Graph g = graph_of(without_some(noisy_sphere(8000, 0.1, 1), 0.1, 2));
  SolveReport report;
  const std::vector<double> s = solve_solidity(g.graph, {}, report);
  EXPECT_GT(report.unknowns, 10000u);
  const ThreadLimit one(1);
  EXPECT_EQ(solve_solidity(g.graph, {}, report), s);
}

TEST(Solidity, NoUnknownsIsNoTrouble) {
  const Graph g = graph_of(TriangleSoup{});
  SolveReport report;
  EXPECT_EQ(solve_solidity(g.graph, {}, report), std::vector<double>{-1});
  EXPECT_EQ(solve_winding(g.graph, {}, report), std::vector<double>{0});
  EXPECT_TRUE(report.converged);
}

TEST(Solidity, TooFewIterationsAreReported) {
  SolveOptions options;
  options.max_iterations = 1;
  const Graph g = graph_of(without_some(sphere(500), 0.2, 1));
  SolveReport report;
  (void)solve_solidity(g.graph, options, report);
  EXPECT_FALSE(report.converged);
  EXPECT_GT(report.residual, options.tolerance);
}

}  // namespace
}  // namespace meshrepair
