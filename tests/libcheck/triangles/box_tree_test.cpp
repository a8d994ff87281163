// SPDX-License-Identifier: MIT
#include <algorithm>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include <check/box_tree.h>

#include "random_geometry.h"

namespace meshrepair {
namespace {

using testing::Random;

std::vector<Box> random_boxes(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Box> boxes(count);
  for (Box& box : boxes) {
    const Vec3d at(random.real(-9, 9), random.real(-9, 9), random.integer(-2, 2));
    box.add(at);
    box.add(Vec3d(at + Vec3d(random.real(0, 1), 0, random.integer(0, 2))));
  }
  return boxes;
}

bool holds(const Box& outer, const Box& inner) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (inner.low[k] < outer.low[k] || inner.high[k] > outer.high[k]) return false;
  }
  return true;
}

TEST(BoxTree, HasEveryItemOnceInABoxThatHoldsIt) {
  for (const std::size_t count : {1u, 2u, 4u, 5u, 8u, 9u, 13u, 1000u, 20000u}) {
    const std::vector<Box> boxes = random_boxes(count, count);
    const BoxTree tree(boxes);
    std::vector<std::uint32_t> items(tree.order().begin(), tree.order().end());
    std::sort(items.begin(), items.end());
    std::vector<std::uint32_t> all(count);
    std::iota(all.begin(), all.end(), 0u);
    ASSERT_EQ(items, all);
    std::size_t in_leaves = 0;
    for (std::size_t n = 0; n < tree.nodes().size(); ++n) {
      const BoxNode& node = tree.nodes()[n];
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
        ASSERT_TRUE(holds(node.box, boxes[tree.order()[i]]));
      }
      if (node.is_leaf()) {
        ASSERT_LE(node.count, BoxTree::kLeafItems);
        in_leaves += node.count;
        continue;
      }
      const BoxNode& left = tree.nodes()[n + 1];
      const BoxNode& right = tree.nodes()[node.right];
      ASSERT_EQ(left.first, node.first);
      ASSERT_EQ(right.first, left.first + left.count);
      ASSERT_EQ(left.count + right.count, node.count);
    }
    EXPECT_EQ(in_leaves, count);
  }
}

TEST(BoxTree, OfNothingIsEmpty) { EXPECT_TRUE(BoxTree({}).nodes().empty()); }

TEST(BoxTree, IsShallowForEqualBoxes) {
  const std::vector<Box> boxes(5000, random_boxes(1, 1)[0]);
  EXPECT_EQ(BoxTree(boxes).nodes().size(), 2 * 1250 - 1u);
}

TEST(Box, TouchingBoxesMeet) {
  Box a, b, c;
  a.add(Vec3d(0, 0, 0));
  a.add(Vec3d(1, 1, 1));
  b.add(Vec3d(1, 1, 1));
  b.add(Vec3d(2, 2, 2));
  c.add(Vec3d(1.5, 0, 0));
  EXPECT_TRUE(a.meets(b));
  EXPECT_TRUE(b.meets(a));
  EXPECT_FALSE(a.meets(c));
  EXPECT_FALSE(a.meets(Box()));
}

}  // namespace
}  // namespace meshrepair
