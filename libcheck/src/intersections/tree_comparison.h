// SPDX-License-Identifier: MIT
// Triangles in a tree of their boxes, compared with each other or with others.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <base/raw_vector.h>
#include <base/shared_progress.h>
#include <check/box_tree.h>
#include <check/internal/triangle_list.h>
#include <check/internal/triangle_pair.h>
#include <check/self_intersections.h>

#include "findings.h"
#include "triangle_hubs.h"

namespace meshrepair::internal {

// Two nodes to be compared, or, if they are one, a node with itself.
struct NodePair {
  std::uint32_t a;
  std::uint32_t b;
};

// The triangles of a list in the order of a tree's leaves, so that what is compared lies together.
struct SortedTriangles {
  SortedTriangles(std::span<const CornerTriangle> given, std::span<const Box> given_boxes,
                  std::span<const std::uint32_t> given_ids, const BoxTree& box_tree);
  SortedTriangles(const TriangleList& list, const BoxTree& box_tree);
  // Drops the list's boxes, so that they are never there twice with the triangles.
  SortedTriangles(TriangleList&& list, const BoxTree& box_tree);

  // Leaves out pairs of triangles with the same hub. `hubs` are those of the triangles as given;
  // empty: there are none.
  void leave_out_hubs(const std::vector<std::uint32_t>& hubs);

  [[nodiscard]] bool may_meet(NodePair pair) const {
    if (!node_hub.empty() && node_hub[pair.a] != internal::kNoHub &&
        node_hub[pair.a] == node_hub[pair.b]) {
      return false;
    }
    return pair.a == pair.b || tree.nodes()[pair.a].box.meets(tree.nodes()[pair.b].box);
  }
  [[nodiscard]] bool left_out(std::uint32_t i, std::uint32_t j) const {
    return !hub.empty() && hub[i] != internal::kNoHub && hub[i] == hub[j];
  }

  void sort_boxes(const TriangleList& list);
  void sort_triangles(const TriangleList& list);

  const BoxTree& tree;
  RawVector<CornerTriangle> triangles;
  RawVector<Box> boxes;
  RawVector<std::uint32_t> ids;
  std::vector<std::uint32_t> hub, node_hub;  // empty: nothing is left out
};

// Each with each; adds the findings of as many tasks as there are, the same whatever the number of
// threads.
void compare(const SortedTriangles& sorted, const SelfIntersectionOptions& options,
             std::vector<Findings>& findings);

// Looks up triangles in a tree of others. The tree is not empty.
class LookUp {
 public:
  LookUp(const SortedTriangles& sorted, double nearness, SharedProgress& progress,
         Findings& findings)
      : sorted_(sorted),
        nodes_(sorted.tree.nodes()),
        nearness_(nearness),
        progress_(progress),
        findings_(findings) {}

  [[nodiscard]] bool may_meet_any(const Box& box) const { return nodes_[0].box.meets(box); }

  // Of two triangles that are both in the tree the pair is found once.
  void run(std::uint32_t id, const CornerTriangle& triangle, const Box& box, bool is_in_tree);

 private:
  [[nodiscard]] Meeting meeting_with(const CornerTriangle& a, const CornerTriangle& b) const;

  const SortedTriangles& sorted_;
  std::span<const BoxNode> nodes_;
  double nearness_;
  SharedProgress& progress_;
  Findings& findings_;
  std::vector<std::uint32_t> stack_;
  std::size_t steps_ = 0;
};

}  // namespace meshrepair::internal
