// SPDX-License-Identifier: MIT
// Which parts of a mesh may have to do with each other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <check/box_tree.h>
#include <mesh/soup.h>

namespace meshrepair {

// Numbered from 0 by their first triangles.
struct PartGroups {
  std::vector<std::uint32_t> of_triangle;
  std::vector<std::size_t> triangles;  // of each group
  std::vector<Box> box;                // of each group; empty where no coordinate is a number

  [[nodiscard]] std::size_t size() const { return box.size(); }
};

// Parts are connected through points. Two are in one group if their boxes meet, each widened by
// this share of its own diagonal, or both are with a third: then neither crosses the other, nor
// lies in it, nor is near it. n log n, however many boxes meet.
[[nodiscard]] PartGroups find_groups(const TriangleSoup& soup, double margin);

// Of each group, its block: numbered from 0. Groups that are near each other are in one block, or
// in one that follows, of at most so many triangles, but for those of a single group.
[[nodiscard]] std::vector<std::uint32_t> divide_into_blocks(const PartGroups& groups,
                                                            std::size_t most_triangles);

}  // namespace meshrepair
