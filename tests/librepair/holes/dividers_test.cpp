// SPDX-License-Identifier: MIT
#include "holes/dividers.h"

#include <algorithm>

#include <gtest/gtest.h>

#include <mesh/topology.h>
#include <repair/orient_parts.h>
#include <repair/repair.h>

#include "shapes.h"
#include "trees.h"

namespace meshrepair::internal {
namespace {

using namespace testing;

constexpr std::uint32_t kLevels = 2;

// A box of two cells along x, each one wide, open at z = 1. Point 6 z + 2 x + y.
TriangleSoup box_with_divider() {
  TriangleSoup soup;
  for (std::uint32_t z = 0; z < kLevels; ++z) {
    for (std::uint32_t x = 0; x < 3; ++x) {
      for (std::uint32_t y = 0; y < 2; ++y) soup.points.emplace_back(x, y, z);
    }
  }
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    soup.triangles.push_back({a, b, c});
    soup.triangles.push_back({a, c, d});
  };
  for (const std::uint32_t x : {0u, 2u}) {
    add(x, x + 1, x + 3, x + 2);
    add(x, x + 2, x + 8, x + 6);
    add(x + 3, x + 1, x + 7, x + 9);
  }
  add(1, 0, 6, 7);
  add(4, 5, 11, 10);
  add(2, 3, 9, 8);
  return soup;
}

std::size_t count_marked(const TriangleSoup& soup) {
  const CleanSoup clean = cleaned(soup);
  const auto triangles = index_triangles(clean);
  const std::vector<char> marked = find_dividers(clean, triangles, EdgeTable(triangles));
  return static_cast<std::size_t>(std::count(marked.begin(), marked.end(), 1));
}

TEST(Dividers, EdgesOfDividersAreNoRims) {
  // One open edge, and three at which three triangles meet: foot and ends.
  EXPECT_EQ(count_marked(box_with_divider()), 1u + 3 * 3);
}

TEST(Dividers, BoxWithDividersIsClosedAtItsRim) {
  for (const bool is_turned : {false, true}) {
    TriangleSoup soup = box_with_divider();
    if (is_turned) std::swap(soup.triangles.back()[0], soup.triangles.back()[1]);
    RepairReport report;
    const Surface solid = repair(soup, {}, report);
    EXPECT_DOUBLE_EQ(signed_volume(solid.mesh), 2);
    EXPECT_EQ(report.holes.closed, 1u);
  }
}

TEST(Dividers, BoxWithoutDividersHasNone) {
  TriangleSoup soup = box_with_divider();
  soup.triangles.resize(soup.triangles.size() - 2);
  EXPECT_EQ(count_marked(soup), 0u);
}

// Both of its faces look outside.
TEST(Dividers, FinOutsideIsNoDivider) {
  TriangleSoup soup = box_with_divider();
  for (Vec3d& p : soup.points) p.z() += p.x() == 1 && p.z() == 1 ? 1 : 0;
  soup.points.emplace_back(3, 0.5, 0);
  soup.triangles.push_back({4, 5, 12});
  EXPECT_EQ(count_marked(soup), 0u);
}

}  // namespace
}  // namespace meshrepair::internal
