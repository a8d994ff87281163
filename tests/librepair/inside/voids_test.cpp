// SPDX-License-Identifier: MIT
#include "inside/voids.h"

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace meshrepair::internal {
namespace {

Link link_between(std::uint32_t below, std::uint32_t above, TriangleId triangle = {}) {
  return {.below = CellId(below), .above = CellId(above), .area = 1, .triangle = triangle};
}

// Space, a solid around a void, and in that a sheet with a way around it, which divides it in two
// cells.
TEST(Voids, LooseSheetInsideLeavesAVoidAVoid) {
  const TriangleId outer(0u), wall(1u), sheet(2u);
  const CellGraph graph({link_between(0, 1, outer), link_between(1, 2, wall),
                         link_between(1, 3, wall), link_between(2, 3, sheet), link_between(2, 3)},
                        {}, {0, 1, 1, 1}, {1, 0, 0, 0});
  IdVector<TriangleId, std::uint32_t> part_of;
  for (const std::uint32_t part : {0u, 1u, 2u}) part_of.push_back(part);
  const Voids voids = find_voids(graph, {0, 1, 1, 1}, {1, 0, 1, 1}, part_of, nullptr);
  EXPECT_EQ(voids.count, 1u);
  EXPECT_EQ(voids.marked, (std::vector<char>{0, 0, 1, 1}));
}

// Space, a wall around a void, and what no wall is left of.
TEST(Voids, FilledVoidsHaveWalls) {
  const TriangleId outer(0u), wall(1u);
  const CellGraph graph({link_between(0, 1, outer), link_between(1, 2, wall)}, {}, {0, 1, 1, 0},
                        {1, 0, 0, 0});
  std::vector<char> solid = {0, 1, 0, 0};
  EXPECT_EQ(fill_voids(graph, solid, nullptr), 1u);
  EXPECT_EQ(solid[2], 1);
}

}  // namespace
}  // namespace meshrepair::internal
