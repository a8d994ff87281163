// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include <check/box_tree.h>
#include <check/part_groups.h>

#include "random_geometry.h"
#include "shapes.h"

namespace meshrepair {
namespace {

TriangleSoup box_at(double x, double size = 1) {
  return testing::box({x, 0, 0}, {x + size, size, size});
}

TriangleSoup all_of(const std::vector<TriangleSoup>& parts) {
  TriangleSoup all;
  for (const TriangleSoup& part : parts) testing::append(all, part);
  return all;
}

std::size_t groups_of(const std::vector<TriangleSoup>& parts, double margin) {
  return find_groups(all_of(parts), margin).size();
}

TEST(PartGroups, PartsWhoseBoxesMeetAreOne) {
  EXPECT_EQ(groups_of({box_at(0), box_at(3)}, 0), 2u);
  EXPECT_EQ(groups_of({box_at(0), box_at(1)}, 0), 1u);
  EXPECT_EQ(groups_of({box_at(0, 9), box_at(3)}, 0), 1u);  // one in the other
  EXPECT_EQ(groups_of({box_at(0), box_at(1.02)}, 0), 2u);
  EXPECT_EQ(groups_of({box_at(0), box_at(1.02)}, 0.01), 1u);
  // The first and the last by the one between them.
  EXPECT_EQ(groups_of({box_at(0), box_at(1.5), box_at(0.8)}, 0), 1u);
}

TEST(PartGroups, SayWhatIsInThem) {
  const PartGroups groups = find_groups(all_of({box_at(5), box_at(0), box_at(5.5)}), 0);
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups.triangles, (std::vector<std::size_t>{24, 12}));
  EXPECT_EQ(groups.of_triangle.front(), 0u);
  EXPECT_EQ(groups.of_triangle[12], 1u);
  EXPECT_EQ(groups.of_triangle.back(), 0u);
  EXPECT_EQ(groups.box[0].low[0], 5);
  EXPECT_EQ(groups.box[0].high[0], 6.5);
}

TEST(PartGroups, WhatIsNoNumberIsAlone) {
  TriangleSoup soup = all_of({box_at(0), box_at(0.5)});
  for (std::size_t p = 8; p < 16; ++p) {
    soup.points[p].x() = std::numeric_limits<double>::quiet_NaN();
  }
  const PartGroups groups = find_groups(soup, 0.1);
  EXPECT_EQ(groups.size(), 2u);
  EXPECT_EQ(divide_into_blocks(groups, 12).size(), 2u);
  TriangleSoup huge = box_at(0);
  huge.points[0].x() = -std::numeric_limits<double>::max();
  huge.points[7].x() = std::numeric_limits<double>::max();
  testing::append(huge, box_at(3));
  EXPECT_EQ(find_groups(huge, 1).size(), 1u);
  EXPECT_EQ(divide_into_blocks(find_groups(huge, 1), 1), (std::vector<std::uint32_t>{0}));
}

// By brute force over all pairs of boxes.
TEST(PartGroups, GroupsAreThoseOfAllPairs) {
  testing::Random random(3);
  for (int round = 0; round < 30; ++round) {
    std::vector<TriangleSoup> parts;
    std::vector<Box> boxes;
    for (int i = 0; i < 40; ++i) {
      const Vec3d low(random.integer(0, 20), random.integer(0, 20), random.integer(0, 20));
      const Vec3d high = low + Vec3d(random.integer(1, 4), random.integer(1, 4), 1);
      parts.push_back(testing::box(low, high));
      boxes.emplace_back().add(low);
      boxes.back().add(high);
    }
    std::vector<std::size_t> group(parts.size());
    for (std::size_t i = 0; i < group.size(); ++i) group[i] = i;
    for (std::size_t again = 0; again < parts.size(); ++again) {
      for (std::size_t i = 0; i < parts.size(); ++i) {
        for (std::size_t k = 0; k < parts.size(); ++k) {
          if (boxes[i].meets(boxes[k])) group[i] = std::min(group[i], group[k]);
        }
      }
    }
    const PartGroups groups = find_groups(all_of(parts), 0);
    EXPECT_EQ(groups.size(), std::set<std::size_t>(group.begin(), group.end()).size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
      for (std::size_t k = 0; k < parts.size(); ++k) {
        EXPECT_EQ(group[i] == group[k], groups.of_triangle[12 * i] == groups.of_triangle[12 * k]);
      }
    }
  }
}

// Each box meets all others: a pair of each would take hours.
TEST(PartGroups, ManyNestedPartsAreOneGroup) {
  constexpr std::uint32_t kParts = 300'000;
  TriangleSoup soup;
  for (std::uint32_t i = 0; i < kParts; ++i) {
    const double size = 1 + 1e-6 * i;
    soup.points.insert(soup.points.end(),
                       {{-size, -size, -size}, {size, size, size}, {-size, size, -size}});
    soup.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  EXPECT_EQ(find_groups(soup, 0).size(), 1u);
}

TEST(Blocks, EachBlockKeepsTheTriangleLimit) {
  std::vector<TriangleSoup> parts;
  for (int i = 0; i < 20; ++i) parts.push_back(box_at(3 * i));
  const PartGroups groups = find_groups(all_of(parts), 0);
  for (const std::size_t most : {1u, 12u, 13u, 36u, 100u, 1000u}) {
    const std::vector<std::uint32_t> block_of = divide_into_blocks(groups, most);
    const std::size_t each = std::max<std::size_t>(1, most / 12);
    std::vector<std::size_t> count(block_of.size(), 0);
    for (const std::uint32_t block : block_of) ++count[block];
    for (const std::size_t c : count) EXPECT_LE(c, each);
    EXPECT_EQ(*std::max_element(block_of.begin(), block_of.end()) + 1, (20 + each - 1) / each);
  }
}

}  // namespace
}  // namespace meshrepair
