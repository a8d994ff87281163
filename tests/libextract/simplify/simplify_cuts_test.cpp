// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <check/check_surface.h>
#include <check/internal/star_distance.h>
#include <check/mesh_distance.h>
#include <check/self_intersections.h>
#include <extract/simplify_cuts.h>
#include <mesh/internal/collapsible_mesh.h>
#include <mesh/topology.h>

#include "each_seed.h"
#include "random_geometry.h"
#include "shapes.h"
#include "share_of_cases.h"
#include "simplify/cut_simplifier.h"
#include "surfaces.h"

namespace meshrepair {
namespace {

using namespace testing;
using internal::CollapsibleMesh;
using internal::CutSimplifier;
using internal::PointStar;
using internal::StarDistance;

// Each side of a unit cube in n x n squares of two triangles.
TriangleSoup squared_cube(std::uint32_t n) {
  TriangleSoup soup;
  const auto index_of = [&](const Vec3d& p) {
    const auto found = std::find(soup.points.begin(), soup.points.end(), p);
    const auto at = static_cast<std::uint32_t>(found - soup.points.begin());
    if (found == soup.points.end()) soup.points.push_back(p);
    return at;
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool far : {false, true}) {
      const auto at = [&](std::uint32_t i, std::uint32_t j) {
        Vec3d p;
        p[axis] = far ? 1 : 0;
        p[(axis + 1) % 3] = static_cast<double>(i) / n;
        p[(axis + 2) % 3] = static_cast<double>(j) / n;
        return index_of(p);
      };
      for (std::uint32_t i = 0; i < n; ++i) {
        for (std::uint32_t j = 0; j < n; ++j) {
          const std::uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1),
                              d = at(i, j + 1);
          soup.triangles.push_back(far ? std::array{a, b, c} : std::array{a, c, b});
          soup.triangles.push_back(far ? std::array{a, c, d} : std::array{a, d, c});
        }
      }
    }
  }
  return soup;
}

// Of a closed surface: with the number of parts it tells the genus.
std::size_t double_euler_number(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  std::vector<std::uint32_t> used;
  for (const auto& t : triangles) used.insert(used.end(), t.begin(), t.end());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  return 2 * used.size() - triangles.size();
}

struct Simplified {
  Surface surface;
  SimplifyReport report;
};

// The points of triangles with a flag in `whole` stay.
Simplified simplify(const TriangleSoup& soup, double within, std::vector<char> whole = {}) {
  Simplified result{as_surface(soup), {}};
  whole.resize(soup.triangles.size(), 0);
  std::vector<char> stays(soup.points.size(), 0);
  for (std::size_t t = 0; t < whole.size(); ++t) {
    for (const std::uint32_t p : soup.triangles[t]) stays[p] |= whole[t];
  }
  SimplifyOptions options;
  options.within = within;
  auto simpler = simplify_cuts(result.surface, stays, options, result.report);
  if (simpler) result.surface = std::move(*simpler);
  EXPECT_EQ(result.surface.source.size(), result.surface.mesh.triangles.size());
  EXPECT_EQ(result.surface.input_point.size(), result.surface.mesh.points.size());
  EXPECT_EQ(result.report.removed_points + result.surface.mesh.points.size(), soup.points.size());
  EXPECT_LE(result.report.distance, within);
  return result;
}

void expect_same_solid(const TriangleSoup& before, const Simplified& after) {
  const TriangleSoup& mesh = after.surface.mesh;
  EXPECT_TRUE(check_surface(mesh).valid_solid());
  const Topology was = examine_topology(before.triangles, before.points.size());
  const Topology is = examine_topology(mesh.triangles, mesh.points.size());
  EXPECT_EQ(is.parts, was.parts);
  EXPECT_EQ(double_euler_number(mesh.triangles), double_euler_number(before.triangles));
  DistanceOptions options;
  options.samples = 20'000;
  EXPECT_LE(mesh_distance(mesh, before, options).forth.largest,
            after.report.distance * (1 + 1e-9) + 1e-15 * bounding_diagonal(before));
}

TEST(SimplifyCuts, FlatSidesNeedTwoTrianglesEach) {
  const TriangleSoup cube = squared_cube(8);
  const Simplified result = simplify(cube, 1e-9);
  EXPECT_EQ(result.surface.mesh.triangles.size(), 12u);
  EXPECT_EQ(result.report.removed_triangles, cube.triangles.size() - 12);
  EXPECT_EQ(result.report.rounds, 1u);
  EXPECT_DOUBLE_EQ(signed_volume(result.surface.mesh), 1);
  expect_same_solid(cube, result);
}

// Each side of the cube in so many stripes, which are sources.
Surface striped_cube(std::uint32_t stripes) {
  const TriangleSoup cube = squared_cube(8);
  Surface surface = as_surface(cube);
  for (std::size_t t = 0; t < cube.triangles.size(); ++t) {
    const auto& c = cube.triangles[t];
    const Vec3d middle = (cube.points[c[0]] + cube.points[c[1]] + cube.points[c[2]]) / 3;
    const std::uint32_t side = static_cast<std::uint32_t>(t / 128);
    const int along = side / 2 == 0 ? 1 : 0;  // not the axis of the side
    surface.source[t] =
        side * stripes + static_cast<std::uint32_t>(middle[along] * static_cast<double>(stripes));
  }
  return surface;
}

// Where sources carry functions of their own, the lines between them stay.
TEST(SimplifyCuts, LinesBetweenSourcesStayWhereTheyAre) {
  for (const std::uint32_t stripes : {1u, 2u, 4u}) {
    const Surface surface = striped_cube(stripes);
    const std::vector<double> reach(6 * std::size_t{stripes}, 1e-12);
    std::vector<char> stays(surface.mesh.points.size(), 0);
    SimplifyOptions options;
    options.within = 1e-9;
    options.reach = reach;
    SimplifyReport report;
    const auto simpler = simplify_cuts(surface, stays, options, report);
    ASSERT_TRUE(simpler);
    std::vector<double> before(reach.size(), 0), after(reach.size(), 0);
    const auto add_areas = [](const Surface& of, std::vector<double>& areas) {
      for (std::size_t t = 0; t < of.source.size(); ++t) {
        const auto& [a, b, c] = of.mesh.triangles[t];
        const auto& at = of.mesh.points;
        areas[of.source[t]] += (at[b] - at[a]).cross(at[c] - at[a]).norm() / 2;
      }
    };
    add_areas(surface, before);
    add_areas(*simpler, after);
    for (std::size_t s = 0; s < before.size(); ++s) EXPECT_NEAR(after[s], before[s], 1e-9);
    EXPECT_LT(simpler->mesh.triangles.size(), surface.mesh.triangles.size() / 4);
  }
}

// A block with a roof on four sides whose top is two points in one place.
TEST(SimplifyCuts, TwoEndsOfAnEdgeInOnePlaceBecomeOne) {
  TriangleSoup house;
  house.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},     {0, 0, 1},
                  {1, 0, 1}, {1, 1, 1}, {0, 1, 1}, {0.5, 0.5, 2}, {0.5, 0.5, 2}};
  house.triangles = {{0, 2, 1}, {0, 3, 2}};
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t j = (i + 1) % 4;
    house.triangles.push_back({i, j, j + 4});
    house.triangles.push_back({i, j + 4, i + 4});
    house.triangles.push_back({i + 4, j + 4, i < 2 ? 8u : 9u});
  }
  house.triangles.push_back({6, 9, 8});
  house.triangles.push_back({4, 8, 9});
  const Simplified result = simplify(house, 1e-6);
  EXPECT_EQ(result.surface.mesh.triangles.size(), 14u);
  EXPECT_TRUE(check_surface(result.surface.mesh).valid_solid());
}

TEST(SimplifyCuts, WithoutABoundNothingChanges) {
  const TriangleSoup cube = squared_cube(4);
  const Simplified result = simplify(cube, 0);
  EXPECT_EQ(result.surface.mesh.points, cube.points);
  EXPECT_EQ(result.surface.mesh.triangles, cube.triangles);
  EXPECT_EQ(result.report.rounds, 0u);
}

TEST(SimplifyCuts, TheSmallestSolidStays) {
  const TriangleSoup tetrahedron{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                 {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}}};
  const Simplified result = simplify(tetrahedron, 100);
  EXPECT_EQ(result.surface.mesh.triangles, tetrahedron.triangles);
}

TEST(SimplifyCuts, WholeTrianglesStay) {
  const TriangleSoup cube = squared_cube(8);
  std::vector<char> whole(cube.triangles.size(), 0);
  for (std::size_t t = 0; t < whole.size(); t += 40) whole[t] = 1;
  const Simplified result = simplify(cube, 1e-9, whole);
  EXPECT_LT(result.surface.mesh.triangles.size(), cube.triangles.size() / 2);
  expect_same_solid(cube, result);
  std::size_t found = 0;
  for (std::size_t t = 0; t < result.surface.mesh.triangles.size(); ++t) {
    const std::uint32_t source = result.surface.source[t];
    if (whole[source] == 0) continue;
    ++found;
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(result.surface.mesh.points[result.surface.mesh.triangles[t][k]],
                cube.points[cube.triangles[source][k]]);
    }
  }
  EXPECT_EQ(found, (cube.triangles.size() + 39) / 40);
  // All of them: not a point may go.
  const Simplified same = simplify(cube, 1, std::vector<char>(cube.triangles.size(), 1));
  EXPECT_EQ(same.surface.mesh.triangles, cube.triangles);
}

TEST(SimplifyCuts, StaysWithinTheBoundOnCurvedSurfaces) {
  for (const double within : {1e-4, 1e-3, 1e-2, 5e-2}) {
    for (const TriangleSoup& soup : {sphere(2000), torus(60, 30)}) {
      const Simplified result = simplify(soup, within);
      expect_same_solid(soup, result);
      EXPECT_EQ(result.report.removed_points > soup.points.size() / 10, within > 2e-3) << within;
    }
  }
}

TEST(SimplifyCuts, StaysWithinTheBoundOnNoisySurfaces) {
  for (std::uint32_t seed = 1; seed <= share_of_cases(20u); ++seed) {
    Random random(seed);
    TriangleSoup soup = squared_cube(6);
    const double noise = std::pow(10.0, random.real(-9, -2));
    for (Vec3d& p : soup.points) {
      for (int axis = 0; axis < 3; ++axis) p[axis] += noise * random.real(-1, 1);
    }
    if (self_intersections(soup).count > 0) continue;
    const Simplified result = simplify(soup, 10 * noise);
    EXPECT_LT(result.surface.mesh.triangles.size(), 200u) << seed;
    expect_same_solid(soup, result);
  }
}

double least_height(const TriangleSoup& soup) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& t : soup.triangles) {
    const Vec3d& a = soup.points[t[0]];
    const Vec3d ab = soup.points[t[1]] - a, ac = soup.points[t[2]] - a;
    least =
        std::min(least, ab.cross(ac).norm() / std::max({ab.norm(), ac.norm(), (ac - ab).norm()}));
  }
  return least;
}

// Once turned, no three points of an edge are on a line in doubles.
TEST(SimplifyCuts, LeavesNoNeedlesAlongEdges) {
  for_each_seed(10, [&](std::uint64_t seed) {
    Random random(seed);
    const Eigen::Matrix3d turn = random_rotation(random);
    TriangleSoup cube = squared_cube(6);
    for (Vec3d& p : cube.points) p = turn * p;
    const double within = 1e-6;
    const Simplified result = simplify(cube, within);
    EXPECT_LE(result.surface.mesh.triangles.size(), 24u) << seed;
    EXPECT_GT(least_height(result.surface.mesh), 1e-4 * within) << seed;
    expect_same_solid(cube, result);
  });
}

// Two skins nearer than what each may move: a thin shell, the inner one turned.
TEST(SimplifyCuts, KeepsNearSkinsApart) {
  TriangleSoup shell = sphere(3000, 1);
  append(shell, flipped(sphere(3000, 0.9999)));
  ASSERT_EQ(self_intersections(shell).count, 0u);
  const Simplified result = simplify(shell, 1e-2);
  EXPECT_GT(result.report.rounds, 1u);
  EXPECT_GT(result.report.points_to_stay, 0u);
  EXPECT_GT(result.report.removed_points, 0u);
  expect_same_solid(shell, result);
}

TEST(SimplifyCuts, TakesOneRoundWithThePointsThatHadToStay) {
  TriangleSoup shell = sphere(3000, 1);
  append(shell, flipped(sphere(3000, 0.9999)));
  const Surface surface = as_surface(shell);
  SimplifyOptions options;
  options.within = 1e-2;
  std::vector<char> stays(shell.points.size(), 0);
  SimplifyReport report;
  const auto first = simplify_cuts(surface, stays, options, report);
  ASSERT_TRUE(first);
  EXPECT_GT(report.rounds, 1u);
  EXPECT_EQ(static_cast<std::size_t>(std::count(stays.begin(), stays.end(), 1)),
            report.points_to_stay);
  const auto second = simplify_cuts(surface, stays, options, report);
  ASSERT_TRUE(second);
  EXPECT_EQ(report.rounds, 1u);
  EXPECT_EQ(report.points_to_stay, 0u);
  EXPECT_EQ(second->mesh.points, first->mesh.points);
  EXPECT_EQ(second->mesh.triangles, first->mesh.triangles);
}

// A void in a bump that is lower than the bound: without the bump it would lie outside.
TEST(SimplifyCuts, MovesNoSurfaceAcrossAnotherPart) {
  TriangleSoup soup = squared_cube(2);
  const auto top = std::find(soup.points.begin(), soup.points.end(), Vec3d(0.5, 0.5, 1));
  ASSERT_NE(top, soup.points.end());
  top->z() += 1e-3;
  EXPECT_EQ(simplify(soup, 1e-2).surface.mesh.triangles.size(), 12u);
  std::vector<char> whole(soup.triangles.size(), 0);
  append(soup, moved(flipped(sphere(100, 1e-4)), {0.5, 0.5, 1 + 5e-4}));
  whole.resize(soup.triangles.size(), 1);
  ASSERT_TRUE(check_surface(soup).valid_solid());
  expect_same_solid(soup, simplify(soup, 1e-2, whole));
}

// Thinner than the bound: they may get flatter, not turn over.
TEST(SimplifyCuts, ThinPartsDoNotTurnOver) {
  for_each_seed(1, 200, [&](std::uint64_t seed) {
    Random random(seed);
    TriangleSoup soup = sphere(40);
    for (Vec3d& p : soup.points) {
      p *= random.real(0.3, 1.3);
      p.z() *= 0.1;
    }
    if (self_intersections(soup).count > 0 || signed_volume(soup) <= 0) return;
    const Simplified result = simplify(soup, random.real(0.1, 1.5));
    EXPECT_TRUE(check_surface(result.surface.mesh).valid_solid()) << seed;
  });
}

TEST(SimplifyCuts, DoesNotDependOnTheUnit) {
  TriangleSoup soup = sphere(2000);
  const Simplified one = simplify(soup, 1e-2);
  for (const double factor : {0x1p-600, 0x1p-300, 0x1p-20, 0x1p20, 0x1p300, 0x1p600}) {
    const Simplified other = simplify(scaled(soup, factor), 1e-2 * factor);
    EXPECT_EQ(other.surface.mesh.triangles, one.surface.mesh.triangles) << factor;
    EXPECT_EQ(other.report.distance, one.report.distance * factor);
  }
}

TEST(SimplifyCuts, WhatIsBesideAFanOfVeryManyTrianglesStays) {
  const TriangleSoup soup = cone(100'000);
  const Simplified result = simplify(soup, 1e-9);
  EXPECT_EQ(result.surface.mesh.triangles, soup.triangles);
}

TEST(CollapsibleMesh, StaysClosedAndManifold) {
  for_each_seed(1, 20, [&](std::uint64_t seed) {
    Random random(seed);
    const TriangleSoup soup = seed % 2 == 0 ? torus(9, 7) : sphere(150);
    const Topology before = examine_topology(soup.triangles, soup.points.size());
    CollapsibleMesh mesh(soup.triangles, soup.points.size());
    PointStar star;
    for (int turn = 0; turn < 2000; ++turn) {
      const auto point = static_cast<std::uint32_t>(
          random.integer(0, static_cast<std::int32_t>(soup.points.size()) - 1));
      if (!mesh.find_star(point, star)) continue;
      const auto to = static_cast<std::size_t>(
          random.integer(0, static_cast<std::int32_t>(star.link.size()) - 1));
      if (mesh.may_collapse(star, to)) mesh.collapse(star, to);
    }
    std::vector<std::array<std::uint32_t, 3>> left;
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
      if (mesh.is_left(t)) left.push_back(mesh.triangles()[t]);
    }
    const Topology after = examine_topology(left, soup.points.size());
    EXPECT_TRUE(after.closed() && after.manifold() && after.oriented()) << seed;
    EXPECT_EQ(double_euler_number(left), double_euler_number(soup.triangles)) << seed;
    EXPECT_EQ(after.parts, before.parts) << seed;
    // No point can go any more: a tetrahedron, or the least torus that there is and what is near.
    EXPECT_LE(left.size(), seed % 2 == 0 ? 40u : 4u) << seed;
  });
}

// Each point, with its neighbours in order from the lowest; nothing for one without triangles.
std::vector<std::vector<std::uint32_t>> links_of(CollapsibleMesh& mesh, std::size_t points) {
  std::vector<std::vector<std::uint32_t>> links(points);
  PointStar star;
  for (std::uint32_t p = 0; p < points; ++p) {
    if (!mesh.find_star(p, star)) continue;
    std::rotate(star.link.begin(), std::min_element(star.link.begin(), star.link.end()),
                star.link.end());
    links[p] = star.link;
  }
  return links;
}

TEST(CollapsibleMesh, IsAsItWasWhenCollapsesAreTakenBack) {
  struct Collapse {
    PointStar star;
    std::uint32_t target;
  };
  for_each_seed(1, 20, [&](std::uint64_t seed) {
    Random random(seed);
    const TriangleSoup soup = seed % 2 == 0 ? torus(9, 7) : sphere(150);
    const std::size_t points = soup.points.size();
    CollapsibleMesh mesh(soup.triangles, points);
    std::vector<Collapse> collapses;
    std::vector<std::vector<std::vector<std::uint32_t>>> before;
    PointStar star;
    for (int turn = 0; turn < 60; ++turn) {
      const auto point =
          static_cast<std::uint32_t>(random.integer(0, static_cast<std::int32_t>(points) - 1));
      if (!mesh.find_star(point, star)) continue;
      const auto to = static_cast<std::size_t>(
          random.integer(0, static_cast<std::int32_t>(star.link.size()) - 1));
      if (!mesh.may_collapse(star, to)) continue;
      before.push_back(links_of(mesh, points));
      collapses.push_back({star, star.link[to]});
      mesh.collapse(star, to);
    }
    ASSERT_GT(collapses.size(), 10u);
    while (!collapses.empty()) {
      const Collapse& last = collapses.back();
      mesh.restore(last.star.point, last.target, last.star.triangles);
      EXPECT_EQ(links_of(mesh, points), before.back()) << seed;
      collapses.pop_back();
      before.pop_back();
    }
    EXPECT_EQ(mesh.triangles(), soup.triangles) << seed;
  });
}

// Points that are told to stay go back to where they were, and others may go instead.
TEST(CutSimplifier, TakesBackMovesAndWhatBuildsOnThem) {
  for_each_seed(1, 20, [&](std::uint64_t seed) {
    Random random(seed);
    const TriangleSoup soup = seed % 2 == 0 ? squared_cube(8) : sphere(400);
    std::vector<char> stays(soup.points.size(), 0);
    const std::vector<double> within(soup.points.size(), 0.2);
    CutSimplifier simplifier(soup, stays, within, {}, nullptr);
    for (int turn = 0; turn < 4; ++turn) {
      simplifier.run();
      std::vector<std::array<std::uint32_t, 3>> left;
      for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        if (!simplifier.mesh().is_left(t)) continue;
        left.push_back(simplifier.mesh().triangles()[t]);
        const bool is_as_it_was = left.back() == soup.triangles[t];
        EXPECT_EQ(is_as_it_was, simplifier.last_moved(t) == CutSimplifier::kNone) << seed;
      }
      const Topology topology = examine_topology(left, soup.points.size());
      EXPECT_TRUE(topology.closed() && topology.manifold() && topology.oriented()) << seed;
      EXPECT_LT(left.size(), soup.triangles.size()) << seed;
      EXPECT_LE(simplifier.distance(), 0.2) << seed;
      const std::vector<std::uint32_t> places = simplifier.places();
      for (std::uint32_t p = 0; p < places.size(); ++p) {
        EXPECT_EQ(simplifier.has_moved(p), places[p] != p) << seed;
        EXPECT_FALSE(simplifier.has_moved(places[p])) << seed;
        EXPECT_TRUE(stays[p] == 0 || places[p] == p) << seed;
        if (simplifier.has_moved(p) && random.integer(0, 9) == 0) stays[p] = 1;
      }
      simplifier.take_back();
    }
    std::fill(stays.begin(), stays.end(), 1);
    simplifier.take_back();
    simplifier.run();
    EXPECT_EQ(simplifier.mesh().triangles(), soup.triangles) << seed;
    EXPECT_EQ(simplifier.distance(), 0) << seed;
  });
}

TEST(CollapsibleMesh, StarsOfVeryManyTrianglesAreLeftAlone) {
  const TriangleSoup soup = cone(CollapsibleMesh::kMostOfStar + 1);
  CollapsibleMesh mesh(soup.triangles, soup.points.size());
  PointStar star;
  EXPECT_FALSE(mesh.find_star(0, star));
  ASSERT_TRUE(mesh.find_star(5, star));
  EXPECT_EQ(star.link.size(), 4u);
  EXPECT_EQ(star.triangles.size(), 4u);
  const TriangleSoup wide = cone(CollapsibleMesh::kMostOfNeighbour + 1);
  CollapsibleMesh beside(wide.triangles, wide.points.size());
  EXPECT_FALSE(beside.find_star(5, star));
}

// A star whose points are anywhere; then the distance is that along the normal, or none is told.
TEST(StarDistance, IsNeverTooSmall) {
  std::size_t told = 0;
  for_each_seed(1, 4000, [&](std::uint64_t seed) {
    Random random(seed);
    const auto size = static_cast<std::size_t>(random.integer(3, 8));
    const double height = std::pow(10.0, random.real(-6, 0.3));
    std::vector<Vec3d> link;
    for (std::size_t i = 0; i < size; ++i) {
      const double angle = 2 * std::numbers::pi * (static_cast<double>(i) + random.real(0, 0.9)) /
                           static_cast<double>(size);
      const double out = random.real(0.05, 1);
      link.emplace_back(out * std::cos(angle), out * std::sin(angle), height * random.real(-1, 1));
    }
    const double aside = seed % 3 == 0 ? 1 : 0.05;  // with 1 the star often folds
    const Vec3d centre(aside * random.real(-1, 1), aside * random.real(-1, 1),
                       height * random.real(-1, 1));
    StarDistance distance;
    distance.set_star(centre, link);
    TriangleSoup star;
    star.points = link;
    star.points.push_back(centre);
    for (std::uint32_t i = 0; i < size; ++i) {
      star.triangles.push_back(
          {static_cast<std::uint32_t>(size), i, static_cast<std::uint32_t>((i + 1) % size)});
    }
    for (std::uint32_t to = 0; to < size; ++to) {
      const double bound = distance.bound(to, std::numeric_limits<double>::infinity());
      if (std::isinf(bound)) continue;
      ++told;
      TriangleSoup other{link, {}};
      for (std::uint32_t i = 0; i < size; ++i) {
        const auto next = static_cast<std::uint32_t>((i + 1) % size);
        if (i != to && next != to) other.triangles.push_back({to, i, next});
      }
      DistanceOptions options;
      options.samples = 100;
      EXPECT_LE(one_sided_distance(other, star, options).largest, bound + 1e-12) << seed;
    }
  });
  EXPECT_GT(told, expected_cases(1000u));
}

}  // namespace
}  // namespace meshrepair
