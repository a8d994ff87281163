// SPDX-License-Identifier: MIT
// Surfaces that are taken apart and put together.
#include <gtest/gtest.h>

#include <extract/surface.h>
#include <mesh/append_soup.h>
#include <mesh/mesh_parts.h>

#include "shapes.h"

namespace meshrepair {
namespace {

using namespace testing;

TEST(Surface, GroupsAreDividedAndPutTogetherAgain) {
  Surface all;
  all.mesh = box({0, 0, 0}, {1, 1, 1});
  append_soup(all.mesh, box({2, 0, 0}, {3, 1, 1}));
  all.mesh.points.emplace_back(9, 9, 9);  // that no triangle has
  for (std::uint32_t t = 0; t < all.mesh.triangles.size(); ++t) all.source.push_back(100 + t);
  for (std::size_t p = 0; p < all.mesh.points.size(); ++p) all.input_point.push_back(p % 3 == 0);

  const std::vector<Surface> groups = divide_surface(all, find_parts(all.mesh));
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[1].source.front(), 112u);
  EXPECT_EQ(groups[1].input_point[1], all.input_point[9]);

  MeshParts second = find_parts(all.mesh);
  second.count = 1;
  for (std::uint32_t& group : second.of_triangle) group = group == 0 ? kNoGroup : 0;
  const std::vector<Surface> one = divide_surface(all, second);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0].mesh.points, groups[1].mesh.points);
  EXPECT_EQ(one[0].mesh.triangles, groups[1].mesh.triangles);
  EXPECT_EQ(one[0].source, groups[1].source);

  Surface again;
  for (const Surface& group : groups) append_surface(again, group);
  all.mesh.points.pop_back();
  all.input_point.pop_back();
  EXPECT_EQ(again.mesh.points, all.mesh.points);
  EXPECT_EQ(again.mesh.triangles, all.mesh.triangles);
  EXPECT_EQ(again.source, all.source);
  EXPECT_EQ(again.input_point, all.input_point);
}

}  // namespace
}  // namespace meshrepair
