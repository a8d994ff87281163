// SPDX-License-Identifier: MIT
#include <algorithm>

#include <gtest/gtest.h>

#include <mesh/topology.h>
#include <repair/repair_options.h>
#include <repair/repair_report.h>

#include "prepare/prepare.h"
#include "sew/close_slits.h"
#include "shapes.h"

namespace meshrepair {
namespace {

using namespace testing;

// Two triangles, turned against each other, at an edge of the last triangle and a point of their
// own.
void append_fin(const Vec3d& tip, TriangleSoup& soup) {
  const auto point = static_cast<std::uint32_t>(soup.points.size());
  const auto [a, b, c] = soup.triangles.back();
  soup.points.push_back(tip);
  soup.triangles.insert(soup.triangles.begin() + 5, {a, b, point});
  soup.triangles.push_back({b, a, point});
}

CleanSoup on_its_grid(const TriangleSoup& soup) {
  CleanReport report;
  return clean_soup(soup, report);
}

TEST(DropCancelled, TakesAWallWithoutInsideAndItsPoints) {
  TriangleSoup soup = cube();
  append_fin({0.5, -1, 0.25}, soup);
  CleanSoup clean = on_its_grid(soup);
  ASSERT_EQ(clean.triangles.size(), 13u);
  EXPECT_EQ(internal::drop_cancelled(clean), 1u);
  const CleanSoup expected = on_its_grid(cube());
  ASSERT_EQ(clean.triangles.size(), 12u);
  EXPECT_EQ(clean.points.raw(), expected.points.raw());
  EXPECT_EQ(clean.grid_points.size(), 8u);
  const Topology topology = examine_topology(index_triangles(clean), clean.points.size());
  EXPECT_EQ(topology.open_edges + topology.nonmanifold_edges, 0u);
  for (const Triangle& t : clean.triangles) {
    const auto& given = soup.triangles.at(t.source);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(clean.points[t.corners[k]], soup.points[given[k]]);
    }
  }
}

TEST(DropCancelled, LeavesTrianglesWithMoreCopiesOneWay) {
  TriangleSoup soup = cube();
  append_fin({0.5, -1, 0.25}, soup);
  append(soup, moved(cube(), {0, 0, 1}));  // cubes with a face in common
  soup.triangles.push_back(soup.triangles.front());
  CleanSoup clean = on_its_grid(soup);
  const auto as_often = [](const Triangle& t) { return t.winding == 0; };
  const auto cancelled = std::count_if(clean.triangles.begin(), clean.triangles.end(), as_often);
  ASSERT_GT(cancelled, 1);
  const std::size_t before = clean.triangles.size();
  EXPECT_EQ(internal::drop_cancelled(clean), static_cast<std::size_t>(cancelled));
  EXPECT_EQ(clean.triangles.size(), before - static_cast<std::size_t>(cancelled));
  EXPECT_TRUE(std::none_of(clean.triangles.begin(), clean.triangles.end(), as_often));
  EXPECT_EQ(internal::drop_cancelled(clean), 0u);
}

// Far apart, they would be joined by patches between their open edges.
TEST(CloseSurface, MakesNoHolesOfFins) {
  TriangleSoup soup = cube();
  append_fin({0.5, -1, 0.25}, soup);
  append(soup, moved(cube(), {50, 0, 0}));
  append_fin({50.5, 0.25, 3}, soup);
  RepairReport report;
  StageMeter meter(report.stages, nullptr);
  const CleanSoup closed = internal::close_surface(soup, {}, report, meter);
  EXPECT_EQ(closed.triangles.size(), 24u);
  EXPECT_EQ(report.holes.loops, 0u);
  EXPECT_EQ(report.input.open_edges, 0u);
  const CleanSoup as_given = internal::close_soup(soup, {}, report, meter);
  EXPECT_GT(as_given.triangles.size(), 24u);
}

}  // namespace
}  // namespace meshrepair
