// SPDX-License-Identifier: MIT
#include <cstdint>

#include <gtest/gtest.h>

#include <check/check_surface.h>
#include <repair/internal/mend_faults.h>

#include "shapes.h"
#include "surfaces.h"

namespace meshrepair {
namespace {

using namespace testing;

// A block with a roof on four sides whose top is two points.
TriangleSoup house(const Vec3d& top, const Vec3d& other_top) {
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1},
                 {1, 0, 1}, {1, 1, 1}, {0, 1, 1}, top,       other_top};
  soup.triangles = {{0, 2, 1}, {0, 3, 2}, {6, 9, 8}, {4, 8, 9}};
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t j = (i + 1) % 4;
    soup.triangles.push_back({i, j, j + 4});
    soup.triangles.push_back({i, j + 4, i + 4});
    soup.triangles.push_back({i + 4, j + 4, i < 2 ? 8u : 9u});
  }
  return soup;
}

TEST(JoinEnds, TwoInOnePlaceBecomeOne) {
  Surface surface = as_surface(house({0.5, 0.5, 2}, {0.5, 0.5, 2}));
  EXPECT_FALSE(check_surface(surface.mesh).valid_solid());
  surface.input_point[8] = 0;
  EXPECT_EQ(internal::join_ends(surface), 1u);
  EXPECT_EQ(surface.mesh.triangles.size(), 14u);
  EXPECT_EQ(surface.mesh.points.size(), 9u);
  EXPECT_EQ(surface.input_point, std::vector<char>(9, 1));
  EXPECT_TRUE(check_surface(surface.mesh).valid_solid());
}

TEST(JoinEnds, EdgesWithLengthStay) {
  const TriangleSoup soup = house({0.5, 0.25, 2}, {0.5, 0.75, 2});
  Surface surface = as_surface(soup);
  EXPECT_EQ(internal::join_ends(surface), 0u);
  EXPECT_EQ(surface.mesh.triangles, soup.triangles);
}

TEST(JoinEnds, TheSmallestSolidStays) {
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1, 0}};
  soup.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  Surface surface = as_surface(soup);
  EXPECT_EQ(internal::join_ends(surface), 0u);
  EXPECT_EQ(surface.mesh.triangles.size(), 4u);
}

}  // namespace
}  // namespace meshrepair
