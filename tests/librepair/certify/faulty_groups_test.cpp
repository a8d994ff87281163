// SPDX-License-Identifier: MIT
#include "certify/faulty_groups.h"

#include <array>

#include <gtest/gtest.h>

#include <check/self_intersections.h>

#include "shapes.h"
#include "surfaces.h"

namespace meshrepair {
namespace {

using namespace testing;
using internal::groups_apart;
using internal::take_groups;
using internal::triangles_at_fault;

// A cube, a smaller one in it, one beside them, and a sphere.
TriangleSoup three_cubes() {
  TriangleSoup soup = cube();
  append(soup, scaled(cube(), 0.5));
  append(soup, moved(cube(), {10, 0, 0}));
  append(soup, moved(sphere(100), {20, 0, 0}));
  return soup;
}

std::uint32_t size_of_cube() { return static_cast<std::uint32_t>(cube().triangles.size()); }

std::vector<Surface> taken(Surface& surface, std::span<const std::uint32_t> at_fault) {
  return take_groups(surface, groups_apart(surface.mesh), at_fault);
}

TEST(FaultyGroups, GroupsAreTakenOneByOne) {
  Surface surface = as_surface(three_cubes());
  const auto groups = taken(surface, std::array{3 * size_of_cube(), 2 * size_of_cube() + 1});
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[0].mesh.triangles, cube().triangles);
  EXPECT_EQ(groups[0].source.front(), 2 * size_of_cube());
  EXPECT_EQ(groups[1].source.front(), 3 * size_of_cube());
  EXPECT_EQ(groups[1].mesh.points, moved(sphere(100), {20, 0, 0}).points);
  EXPECT_EQ(surface.mesh.triangles.size(), 2 * size_of_cube());
  EXPECT_EQ(surface.source.back(), 2 * size_of_cube() - 1);
}

TEST(FaultyGroups, GroupsIncludeWhatLiesInside) {
  Surface surface = as_surface(three_cubes());
  const auto groups = taken(surface, std::array{size_of_cube()});
  ASSERT_EQ(groups.size(), 1u);
  EXPECT_EQ(groups[0].source.front(), 0u);
  EXPECT_EQ(groups[0].source.back(), 2 * size_of_cube() - 1);
}

TEST(FaultyGroups, AllGroupsMayBeFaulty) {
  Surface surface = as_surface(three_cubes());
  const auto groups = taken(surface, std::array{0u, 2 * size_of_cube(), 3 * size_of_cube()});
  EXPECT_EQ(groups.size(), 3u);
  EXPECT_TRUE(surface.mesh.triangles.empty());
  EXPECT_TRUE(surface.mesh.points.empty());
}

TEST(FaultyGroups, AreOneWhereAllHangsTogether) {
  TriangleSoup soup = cube();
  append(soup, moved(cube(), {0.5, 0.5, 0.5}));
  EXPECT_EQ(groups_apart(soup).size(), 1u);
}

TEST(TrianglesAtFault, AreThoseOfAllKindsOfFaults) {
  TriangleSoup soup = cube();
  append(soup, moved(cube(), {0.5, 0.25, 0.125}));
  const auto flat = static_cast<std::uint32_t>(soup.triangles.size());
  append(soup, {{{5, 0, 0}, {6, 0, 0}, {7, 0, 0}}, {{{0, 1, 2}}}});
  append(soup, {{{7, 0, 0}, {9, 0, 0}, {9, 1, 0}}, {{{0, 1, 2}}}});
  const SelfIntersections found = self_intersections(soup);
  ASSERT_EQ(found.degenerate, 1u);
  std::vector<char> is_listed(soup.triangles.size(), 0);
  for (const std::uint32_t t : triangles_at_fault(soup, found, false)) is_listed[t] = 1;
  EXPECT_EQ(is_listed[flat], 1);
  EXPECT_EQ(is_listed[flat + 1], 0);
  for (const auto& pair : found.pairs) {
    EXPECT_EQ(is_listed[pair[0]], 1);
    EXPECT_EQ(is_listed[pair[1]], 1);
  }
  for (const std::uint32_t t : triangles_at_fault(soup, found, true)) is_listed[t] = 1;
  EXPECT_EQ(is_listed[flat + 1], 1);
}

}  // namespace
}  // namespace meshrepair
