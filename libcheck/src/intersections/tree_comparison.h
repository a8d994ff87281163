// SPDX-License-Identifier: MIT
// Triangles in a tree of their boxes, compared with each other.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <base/ids.h>
#include <base/raw_vector.h>
#include <base/shared_progress.h>
#include <check/box_tree.h>
#include <check/internal/node_pairs.h>
#include <check/internal/oriented_boxes.h>
#include <check/internal/triangle_list.h>
#include <check/internal/triangle_pair.h>
#include <check/self_intersections.h>

#include "findings.h"

namespace meshrepair::internal {

// Are items i and j in one of the groups? Empty: there are none.
[[nodiscard]] inline bool have_one_group(std::span<const std::uint32_t> groups, std::uint32_t i,
                                         std::uint32_t j) {
  return !groups.empty() && groups[i] != kNone && groups[i] == groups[j];
}

// Boxes of what is looked for within a distance reach so much farther, so that rounding does not
// decide.
inline constexpr double kRoom = 1.01;

// The triangles of a list in the order of a tree's leaves, so that what is compared lies together.
struct SortedTriangles {
  SortedTriangles(std::span<const CornerTriangle> given, std::span<const Box> given_boxes,
                  std::span<const std::uint32_t> given_ids, const BoxTree& box_tree);
  // Drops the list's boxes, so that they are never there twice with the triangles.
  SortedTriangles(TriangleList&& list, const BoxTree& box_tree);

  // Leaves out pairs of triangles with the same group, but for kNone. `groups` are those of the
  // triangles as given; empty: there are none. May be called again, with other groups.
  void leave_out(std::span<const std::uint32_t> groups);

  // Leaves out pairs without one of these, of which `is_listed` is not 0: by their ids.
  void leave_out_unlisted(std::span<const char> is_listed);

  // As SelfIntersectionOptions::nearness.
  void look_within(double distance) {
    nearness = distance;
    reach = kRoom * distance;
  }

  // For long triangles.
  void use_oriented_boxes();

  [[nodiscard]] bool may_meet(NodePair pair) const {
    if (!node_is_listed.empty() && node_is_listed[pair.a] == 0 && node_is_listed[pair.b] == 0) {
      return false;
    }
    for (const Groups& groups : left_out_groups) {
      if (have_one_group(groups.of_node, pair.a, pair.b)) return false;
    }
    if (pair.a == pair.b) return true;
    Box around = tree.nodes()[pair.a].box;
    around.widen(reach);
    return around.meets(tree.nodes()[pair.b].box) &&
           (!oriented || oriented->are_within(reach, pair.a, pair.b));
  }
  [[nodiscard]] bool left_out(std::uint32_t i, std::uint32_t j) const {
    if (!is_listed.empty() && is_listed[i] == 0 && is_listed[j] == 0) return true;
    return std::any_of(left_out_groups.begin(), left_out_groups.end(), [&](const Groups& groups) {
      return have_one_group(groups.of_triangle, i, j);
    });
  }

  void sort_boxes(const TriangleList& list);
  void sort_triangles(const TriangleList& list);

  const BoxTree& tree;
  RawVector<CornerTriangle> triangles;
  RawVector<Box> boxes;
  RawVector<std::uint32_t> ids;
  struct Groups {
    std::vector<std::uint32_t> of_triangle;
    std::vector<std::uint32_t> of_node;  // that of all its triangles, or kNone
  };
  std::vector<Groups> left_out_groups;
  std::vector<char> is_listed, node_is_listed;  // empty: all are
  std::optional<OrientedBoxes> oriented;        // none: boxes tell enough
  double nearness = 0;
  double reach = 0;  // of boxes
};

// Each with each; adds the findings of as many tasks as there are, the same whatever the number of
// threads.
void compare(const SortedTriangles& sorted, const SelfIntersectionOptions& options,
             std::vector<Findings>& findings);

}  // namespace meshrepair::internal
