// SPDX-License-Identifier: MIT
// The tree is compared with itself: two nodes whose boxes meet, then their children, down to pairs
// of triangles, which are tested exactly. The upper part of that walk becomes a list of tasks.
#include "tree_comparison.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include <base/parallel.h>

namespace meshrepair::internal {
namespace {

// Enough that all threads end at about the same time.
constexpr std::size_t kTasks = 1024;
constexpr std::size_t kSortedPerTask = 4096;
// A few hundred microseconds of work.
constexpr std::size_t kStepsPerQuestion = 4096;

// Calls visit(a, b) for each pair of children to be compared further.
template <class Visit>
void split(std::span<const BoxNode> nodes, NodePair pair, Visit visit) {
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

bool both_are_leaves(std::span<const BoxNode> nodes, NodePair pair) {
  return nodes[pair.a].is_leaf() && nodes[pair.b].is_leaf();
}

std::vector<NodePair> make_tasks(const SortedTriangles& sorted) {
  const std::span<const BoxNode> nodes = sorted.tree.nodes();
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
      split(nodes, task, [&](NodePair part) {
        if (sorted.may_meet(part)) finer.push_back(part);
      });
    }
    tasks.swap(finer);
  }
  return tasks;
}

// The walk below one task.
class TreeComparison {
 public:
  TreeComparison(const SortedTriangles& sorted, SharedProgress& progress, Findings& findings)
      : sorted_(sorted), nodes_(sorted.tree.nodes()), progress_(progress), findings_(findings) {}

  void run(NodePair task) {
    stack_.assign(1, task);
    while (!stack_.empty()) {
      const NodePair pair = stack_.back();
      stack_.pop_back();
      if (++steps_ % kStepsPerQuestion == 0) progress_.poll();
      if (both_are_leaves(nodes_, pair)) {
        compare_leaves(pair);
      } else {
        split(nodes_, pair, [&](NodePair part) {
          if (sorted_.may_meet(part)) stack_.push_back(part);
        });
      }
    }
  }

 private:
  void compare_leaves(NodePair pair) {
    const BoxNode& a = nodes_[pair.a];
    const BoxNode& b = nodes_[pair.b];
    for (std::uint32_t i = a.first; i < a.first + a.count; ++i) {
      const Box& box = sorted_.boxes[i];
      for (std::uint32_t j = pair.a == pair.b ? i + 1 : b.first; j < b.first + b.count; ++j) {
        if (!box.meets(sorted_.boxes[j]) || sorted_.left_out(i, j)) continue;
        const Meeting meeting = meeting_of(sorted_.triangles[i], sorted_.triangles[j]);
        if (meeting != Meeting::apart) findings_.add(sorted_.ids[i], sorted_.ids[j], meeting);
      }
    }
  }

  const SortedTriangles& sorted_;
  std::span<const BoxNode> nodes_;
  SharedProgress& progress_;
  Findings& findings_;
  std::vector<NodePair> stack_;
  std::size_t steps_ = 0;
};

}  // namespace

SortedTriangles::SortedTriangles(std::span<const CornerTriangle> given,
                                 std::span<const Box> given_boxes,
                                 std::span<const std::uint32_t> given_ids, const BoxTree& box_tree)
    : tree(box_tree) {
  triangles.reserve(given.size());
  boxes.reserve(given.size());
  ids.reserve(given.size());
  for (const std::uint32_t item : tree.order()) {
    triangles.push_back(given[item]);
    boxes.push_back(given_boxes[item]);
    ids.push_back(given_ids[item]);
  }
}

SortedTriangles::SortedTriangles(const TriangleList& list, const BoxTree& box_tree)
    : tree(box_tree) {
  sort_boxes(list);
  sort_triangles(list);
}

SortedTriangles::SortedTriangles(TriangleList&& list, const BoxTree& box_tree) : tree(box_tree) {
  sort_boxes(list);
  list.drop_boxes();
  sort_triangles(list);
}

void SortedTriangles::sort_boxes(const TriangleList& list) {
  boxes.resize(list.size());
  parallel_tasks(list.size(), kSortedPerTask,
                 [&](std::size_t, std::size_t first, std::size_t last) {
                   for (std::size_t i = first; i < last; ++i) {
                     boxes[i] = list.boxes()[tree.order()[i]];
                   }
                 });
}

void SortedTriangles::sort_triangles(const TriangleList& list) {
  triangles.resize(list.size());
  ids.resize(list.size());
  parallel_tasks(list.size(), kSortedPerTask,
                 [&](std::size_t, std::size_t first, std::size_t last) {
                   for (std::size_t i = first; i < last; ++i) {
                     triangles[i] = list.triangle(tree.order()[i]);
                     ids[i] = list.ids()[tree.order()[i]];
                   }
                 });
}

void SortedTriangles::leave_out_hubs(const std::vector<std::uint32_t>& hubs) {
  if (hubs.empty()) return;
  for (const std::uint32_t item : tree.order()) hub.push_back(hubs[item]);
  node_hub.assign(tree.nodes().size(), internal::kNoHub);
  for (std::size_t n = tree.nodes().size(); n-- > 0;) {  // children come behind their parent
    const BoxNode& node = tree.nodes()[n];
    if (!node.is_leaf()) {
      if (node_hub[n + 1] == node_hub[node.right]) node_hub[n] = node_hub[n + 1];
      continue;
    }
    const auto first = hub.begin() + static_cast<std::ptrdiff_t>(node.first);
    if (std::all_of(first, first + static_cast<std::ptrdiff_t>(node.count),
                    [&](std::uint32_t h) { return h == *first; })) {
      node_hub[n] = *first;
    }
  }
}

void compare(const SortedTriangles& sorted, const SelfIntersectionOptions& options,
             std::vector<Findings>& findings) {
  const std::vector<NodePair> tasks = make_tasks(sorted);
  const std::size_t before = findings.size();
  findings.resize(before + tasks.size(), Findings(options.most_pairs));
  SharedProgress progress(options.progress, tasks.size());
  std::atomic<bool> enough = false;
  parallel_for(tasks.size(), [&](std::size_t i) {
    if (!enough) TreeComparison(sorted, progress, findings[before + i]).run(tasks[i]);
    if (options.only_whether && findings[before + i].any()) enough = true;
    progress.done();
  });
}

void LookUp::run(std::uint32_t id, const CornerTriangle& triangle, const Box& box,
                 bool is_in_tree) {
  stack_.assign(1, 0);
  while (!stack_.empty()) {
    const std::uint32_t n = stack_.back();
    stack_.pop_back();
    if (++steps_ % kStepsPerQuestion == 0) progress_.poll();
    const BoxNode& node = nodes_[n];
    if (!node.box.meets(box)) continue;
    if (!node.is_leaf()) {
      stack_.push_back(node.right);
      stack_.push_back(n + 1);
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const std::uint32_t other = sorted_.ids[i];
      if (other == id || (is_in_tree && other < id) || !sorted_.boxes[i].meets(box)) continue;
      const Meeting meeting = meeting_with(triangle, sorted_.triangles[i]);
      if (meeting != Meeting::apart) findings_.add(id, other, meeting);
    }
  }
}

Meeting LookUp::meeting_with(const CornerTriangle& a, const CornerTriangle& b) const {
  const Meeting meeting = meeting_of(a, b);
  if (meeting != Meeting::apart || nearness_ == 0) return meeting;
  return nearly_overlap(a, b, nearness_) ? Meeting::coplanar : Meeting::apart;
}

}  // namespace meshrepair::internal
