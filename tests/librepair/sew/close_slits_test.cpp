// SPDX-License-Identifier: MIT
#include "sew/close_slits.h"

#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <mesh/topology.h>
#include <repair/orient_parts.h>
#include <repair/repair.h>

#include "shapes.h"
#include "share_of_cases.h"

namespace meshrepair {
namespace {

using namespace testing;

CleanSoup cleaned(const TriangleSoup& soup) {
  CleanReport report;
  return clean_soup(soup, report);
}

Topology topology_of(const CleanSoup& soup) {
  return examine_topology(index_triangles(soup), soup.points.size());
}

double volume_of(const CleanSoup& soup) {
  return signed_volume({{soup.points.begin(), soup.points.end()}, index_triangles(soup)});
}

// Triangle t becomes a fan, with points at these shares of the way along its first side.
void split(TriangleSoup& soup, std::size_t t, const std::vector<double>& shares) {
  const auto [a, b, c] = soup.triangles[t];
  const Vec3d from = soup.points[a], way = soup.points[b] - from;
  std::uint32_t last = a;
  for (const double share : shares) {
    const auto next = static_cast<std::uint32_t>(soup.points.size());
    soup.points.emplace_back(from + share * way);
    soup.triangles.push_back({last, next, c});
    last = next;
  }
  soup.triangles[t] = {last, b, c};
}

// All coordinates are multiples of 2^-8, so that a fourth of the way is on the grid.
TriangleSoup coarse_sphere(std::size_t triangles) {
  TriangleSoup soup = sphere(triangles);
  for (Vec3d& p : soup.points) p = (p * 256).array().round() / 256;
  return soup;
}

TEST(CloseSlits, GivesTheNeighbourOfADroppedTriangleItsCorner) {
  TriangleSoup soup = cube();
  const auto [a, b, c] = soup.triangles[0];
  split(soup, 0, {0.25});
  soup.triangles.push_back({a, b, 8});  // without area
  CleanSoup clean = cleaned(soup);
  ASSERT_EQ(clean.triangles.size(), 13u);
  ASSERT_EQ(topology_of(clean).open_edges, 3u);
  EXPECT_EQ(internal::close_slits(clean), 1u);
  EXPECT_EQ(clean.triangles.size(), 14u);
  EXPECT_TRUE(topology_of(clean).closed());
  EXPECT_TRUE(topology_of(clean).oriented());
  EXPECT_NEAR(volume_of(clean), 1, 1e-12);
}

TEST(CloseSlits, ClosesSlitsWithOtherCornersOnBothSides) {
  TriangleSoup soup = coarse_sphere(200);
  std::mt19937 random(7);
  for (std::uint64_t seed = 0; seed < share_of_cases(20u); ++seed) {
    TriangleSoup torn = soup;
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
      std::vector<double> shares;
      for (const double share : {0.25, 0.5, 0.75}) {
        if (random() % 3 == 0) shares.push_back(share);
      }
      std::rotate(torn.triangles[t].begin(), torn.triangles[t].begin() + random() % 3,
                  torn.triangles[t].end());
      split(torn, t, shares);
    }
    CleanSoup clean = cleaned(torn);
    ASSERT_GT(topology_of(clean).open_edges, 0u);
    EXPECT_GT(internal::close_slits(clean), 0u);
    EXPECT_TRUE(topology_of(clean).closed());
    EXPECT_TRUE(topology_of(clean).manifold());
    EXPECT_TRUE(topology_of(clean).oriented());
    EXPECT_NEAR(volume_of(clean), signed_volume(soup), 1e-12);
    EXPECT_TRUE(
        std::is_sorted(clean.triangles.begin(), clean.triangles.end(),
                       [](const Triangle& a, const Triangle& b) { return a.source < b.source; }));
  }
}

// Below one edge a triangle is missing: what is open there is no slit.
TEST(CloseSlits, LeavesHoles) {
  TriangleSoup soup = coarse_sphere(200);
  soup.triangles.erase(soup.triangles.begin() + 100);
  CleanSoup clean = cleaned(soup);
  EXPECT_EQ(internal::close_slits(clean), 0u);
  EXPECT_EQ(clean.triangles.size(), soup.triangles.size());
  EXPECT_EQ(topology_of(clean).open_edges, 3u);
}

TEST(CloseSlits, LeavesSlitsThatArePartOfAHole) {
  TriangleSoup soup = cube();
  split(soup, 0, {0.25, 0.5});
  soup.triangles.pop_back();
  CleanSoup clean = cleaned(soup);
  const Topology before = topology_of(clean);
  EXPECT_EQ(internal::close_slits(clean), 0u);
  EXPECT_EQ(topology_of(clean).open_edges, before.open_edges);
}

// A sheet stands on the rim of an open box, with a corner in the middle of an edge.
TEST(CloseSlits, LeavesSheetsOnARim) {
  TriangleSoup soup = cube();
  const auto [a, b, c] = soup.triangles[0];
  std::erase_if(soup.triangles, [&, from = a, to = b, apex = c](const auto& t) {
    const auto has = [&](std::uint32_t p) { return std::count(t.begin(), t.end(), p) > 0; };
    return has(from) && has(to) && !has(apex);
  });
  const Vec3d up(1, 2, 4);
  const auto first = static_cast<std::uint32_t>(soup.points.size());
  soup.points.emplace_back((soup.points[a] + soup.points[b]) / 2);
  soup.points.emplace_back(soup.points[a] + up);
  soup.points.emplace_back(soup.points[b] + up);
  soup.triangles.push_back({b, first, first + 2});
  soup.triangles.push_back({first, a, first + 1});
  soup.triangles.push_back({first, first + 1, first + 2});
  CleanSoup clean = cleaned(soup);
  EXPECT_EQ(internal::close_slits(clean), 0u);
}

// A piece of the first triangle is there already: the second one. Nothing else is open.
TEST(CloseSlits, MakesNoTriangleTwice) {
  const TriangleSoup soup = {{{0, 0, 0}, {4, 0, 0}, {1, 0, 0}, {0, 4, 0}, {0, 0, 4}},
                             {{{0, 1, 3}}, {{1, 2, 3}}, {{0, 2, 4}}, {{2, 3, 4}}, {{3, 0, 4}}}};
  CleanSoup clean = cleaned(soup);
  ASSERT_EQ(topology_of(clean).open_edges, 3u);
  EXPECT_EQ(internal::close_slits(clean), 0u);
  EXPECT_EQ(clean.triangles.size(), soup.triangles.size());
}

// Tetrahedra, one edge of each on one line, where these overlap. One of the two triangles at it is
// in two pieces.
CleanSoup tetrahedra_along_a_line(std::uint32_t count) {
  TriangleSoup soup;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double from = i, middle = count + i, to = 2 * count + i;
    append(soup, {{{from, 0, 0}, {to, 0, 0}, {middle, 0, 0}, {from, 1.0 + i, 0}, {to, 0, 1.0 + i}},
                  {{{0, 1, 3}}, {{2, 0, 4}}, {{1, 2, 4}}, {{0, 3, 4}}, {{3, 1, 4}}}});
  }
  return cleaned(soup);
}

TEST(CloseSlits, LeavesSlitsThatTakeVeryManyPieces) {
  CleanSoup few = tetrahedra_along_a_line(3);
  ASSERT_EQ(topology_of(few).open_edges, 9u);
  EXPECT_EQ(internal::close_slits(few), 1u);
  EXPECT_TRUE(topology_of(few).closed());
  CleanSoup many = tetrahedra_along_a_line(200);
  const std::size_t before = many.triangles.size();
  EXPECT_EQ(internal::close_slits(many), 0u);
  EXPECT_EQ(many.triangles.size(), before);
}

TEST(CloseSlits, SparesTheCellsOfAWholeMesh) {
  TriangleSoup soup = coarse_sphere(500);
  append(soup, moved(coarse_sphere(500), {0.75, 0.125, 0.25}));
  const auto [a, b, c] = soup.triangles[3];
  const auto fresh = static_cast<std::uint32_t>(soup.points.size());
  split(soup, 3, {0.5});
  soup.triangles.push_back({a, b, fresh});
  RepairOptions options;
  RepairReport report;
  const Surface surface = repair(soup, options, report);
  EXPECT_EQ(report.clean.dropped_degenerate, 1u);
  EXPECT_EQ(report.holes.slits, 1u);
  EXPECT_GT(report.arrange.chambers, 0u);
  EXPECT_EQ(report.cells, 0u);
  EXPECT_TRUE(report.certify.passed());
  RepairReport of_whole;
  TriangleSoup whole = coarse_sphere(500);
  append(whole, moved(coarse_sphere(500), {0.75, 0.125, 0.25}));
  EXPECT_NEAR(signed_volume(surface.mesh), signed_volume(repair(whole, {}, of_whole).mesh), 1e-9);
}

}  // namespace
}  // namespace meshrepair
