// SPDX-License-Identifier: MIT
#include "common/drop_thin_parts.h"

#include <vector>

#include <gtest/gtest.h>

#include "shapes.h"
#include "surfaces.h"

namespace meshrepair {
namespace {

using namespace testing;
using internal::drop_thin_crumbs;

// Twelve triangles each.
TriangleSoup cube_and(const TriangleSoup& box) {
  TriangleSoup soup = cube();
  append(soup, box);
  return soup;
}

const TriangleSoup thin = box({2, 0, 0}, {3, 1, 1e-9});

TEST(DropThinCrumbs, TakesOnlyCrumbsOfCutPieces) {
  Surface surface = as_surface(cube_and(thin));
  std::vector<char> whole(24, 0);
  EXPECT_EQ(drop_thin_crumbs(surface, whole, 1e-10), 0u);
  EXPECT_EQ(drop_thin_crumbs(surface, whole, 1e-8), 1u);
  EXPECT_EQ(surface.mesh.triangles, cube().triangles);
  EXPECT_EQ(surface.source.size(), 12u);
  EXPECT_EQ(surface.input_point.size(), 8u);
}

TEST(DropThinCrumbs, LeavesCrumbsWithAWholeTriangle) {
  Surface surface = as_surface(cube_and(thin));
  std::vector<char> whole(24, 0);
  whole[17] = 1;
  EXPECT_EQ(drop_thin_crumbs(surface, whole, 1e-8), 0u);
  EXPECT_EQ(surface.mesh.triangles.size(), 24u);
}

TEST(DropThinCrumbs, TakesCracksInside) {
  Surface surface = as_surface(cube_and(flipped(box({0.2, 0.2, 0.5}, {0.8, 0.8, 0.5 + 1e-9}))));
  EXPECT_EQ(drop_thin_crumbs(surface, std::vector<char>(24, 0), 1e-8), 1u);
  EXPECT_EQ(surface.mesh.triangles, cube().triangles);
}

TEST(DropThinCrumbs, KeepsOnePartAtLeast) {
  TriangleSoup soup = thin;
  append(soup, moved(thin, {2, 0, 0}));
  Surface surface = as_surface(soup);
  EXPECT_EQ(drop_thin_crumbs(surface, std::vector<char>(24, 0), 1e-8), 0u);
  EXPECT_EQ(surface.mesh.triangles.size(), 24u);
}

}  // namespace
}  // namespace meshrepair
