// SPDX-License-Identifier: MIT
// A tree compared with itself: two nodes that may meet, then their children, down to pairs of
// leaves.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <check/box_tree.h>

namespace meshrepair::internal {

// Two nodes to be compared, or, if they are one, a node with itself.
struct NodePair {
  std::uint32_t a;
  std::uint32_t b;
};

// Calls visit(pair) for each pair of children to be compared further.
template <class Visit>
void split_node_pair(std::span<const BoxNode> nodes, NodePair pair, Visit visit) {
  const auto [a, b] = pair;
  if (a == b) {
    visit(NodePair{a + 1, a + 1});
    visit(NodePair{nodes[a].right, nodes[a].right});
    visit(NodePair{a + 1, nodes[a].right});
  } else if (nodes[b].is_leaf() || (!nodes[a].is_leaf() && nodes[a].count >= nodes[b].count)) {
    visit(NodePair{a + 1, b});
    visit(NodePair{nodes[a].right, b});
  } else {
    visit(NodePair{a, b + 1});
    visit(NodePair{a, nodes[b].right});
  }
}

[[nodiscard]] inline bool both_are_leaves(std::span<const BoxNode> nodes, NodePair pair) {
  return nodes[pair.a].is_leaf() && nodes[pair.b].is_leaf();
}

// The upper part of the walk, as tasks: enough that all threads end at about the same time.
// may_meet(pair) says whether to go on.
template <class MayMeet>
[[nodiscard]] std::vector<NodePair> upper_node_pairs(std::span<const BoxNode> nodes,
                                                     const MayMeet& may_meet) {
  constexpr std::size_t kTasks = 1024;
  std::vector<NodePair> tasks;
  if (nodes.empty()) return tasks;
  tasks.push_back({0, 0});
  bool has_split = true;
  while (has_split && tasks.size() < kTasks) {
    has_split = false;
    std::vector<NodePair> finer;
    for (const NodePair& task : tasks) {
      if (both_are_leaves(nodes, task)) {
        finer.push_back(task);
        continue;
      }
      has_split = true;
      split_node_pair(nodes, task, [&](NodePair part) {
        if (may_meet(part)) finer.push_back(part);
      });
    }
    tasks.swap(finer);
  }
  return tasks;
}

// Calls visit(pair) for the pairs of leaves below `from`.
template <class MayMeet, class Visit>
void walk_node_pairs(std::span<const BoxNode> nodes, NodePair from, const MayMeet& may_meet,
                     const Visit& visit) {
  std::vector<NodePair> waiting(1, from);
  while (!waiting.empty()) {
    const NodePair pair = waiting.back();
    waiting.pop_back();
    if (both_are_leaves(nodes, pair)) {
      visit(pair);
    } else {
      split_node_pair(nodes, pair, [&](NodePair part) {
        if (may_meet(part)) waiting.push_back(part);
      });
    }
  }
}

}  // namespace meshrepair::internal
