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

constexpr std::size_t kSortedPerTask = 4096;
// A few hundred microseconds of work.
constexpr std::size_t kStepsPerQuestion = 4096;

// The walk below one task.
class TreeComparison {
 public:
  TreeComparison(const SortedTriangles& sorted, SharedProgress& progress, Findings& findings)
      : sorted_(sorted), nodes_(sorted.tree.nodes()), progress_(progress), findings_(findings) {}

  void run(NodePair task) {
    walk_node_pairs(
        nodes_, task,
        [&](NodePair pair) {
          if (++steps_ % kStepsPerQuestion == 0) progress_.poll();
          return sorted_.may_meet(pair);
        },
        [&](NodePair pair) { compare_leaves(pair); });
  }

 private:
  void compare_leaves(NodePair pair) {
    const BoxNode& a = nodes_[pair.a];
    const BoxNode& b = nodes_[pair.b];
    for (std::uint32_t i = a.first; i < a.first + a.count; ++i) {
      Box box = sorted_.boxes[i];
      box.widen(sorted_.reach);
      for (std::uint32_t j = pair.a == pair.b ? i + 1 : b.first; j < b.first + b.count; ++j) {
        if (!box.meets(sorted_.boxes[j]) || sorted_.left_out(i, j)) continue;
        const Meeting meeting = meeting_with(sorted_.triangles[i], sorted_.triangles[j]);
        if (meeting != Meeting::apart) findings_.add(sorted_.ids[i], sorted_.ids[j], meeting);
      }
    }
  }

  [[nodiscard]] Meeting meeting_with(const CornerTriangle& a, const CornerTriangle& b) const {
    const Meeting meeting = meeting_of(a, b);
    if (meeting != Meeting::apart || sorted_.nearness == 0) return meeting;
    return nearly_overlap(a, b, sorted_.nearness) ? Meeting::coplanar : Meeting::apart;
  }

  const SortedTriangles& sorted_;
  std::span<const BoxNode> nodes_;
  SharedProgress& progress_;
  Findings& findings_;
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

void SortedTriangles::leave_out_unlisted(std::span<const char> listed) {
  is_listed.resize(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) is_listed[i] = listed[ids[i]];
  node_is_listed.assign(tree.nodes().size(), 0);
  for (std::size_t n = tree.nodes().size(); n-- > 0;) {  // children come behind their parent
    const BoxNode& node = tree.nodes()[n];
    if (node.is_leaf()) {
      const std::span<const char> items(is_listed.data() + node.first, node.count);
      node_is_listed[n] = std::find(items.begin(), items.end(), 1) != items.end() ? 1 : 0;
    } else {
      node_is_listed[n] = static_cast<char>(node_is_listed[n + 1] | node_is_listed[node.right]);
    }
  }
}

void SortedTriangles::use_oriented_boxes() {
  std::vector<Vec3d> corners;
  corners.reserve(3 * triangles.size());
  for (const CornerTriangle& triangle : triangles) {
    corners.insert(corners.end(), triangle.at.begin(), triangle.at.end());
  }
  oriented.emplace(tree, std::move(corners));
}

void SortedTriangles::leave_out(std::span<const std::uint32_t> groups) {
  if (groups.empty()) return;
  Groups& sorted = left_out_groups.emplace_back();
  sorted.of_triangle.resize(tree.order().size());
  parallel_for(tree.order().size(),
               [&](std::size_t i) { sorted.of_triangle[i] = groups[tree.order()[i]]; });
  sorted.of_node.assign(tree.nodes().size(), kNone);
  for (std::size_t n = tree.nodes().size(); n-- > 0;) {  // children come behind their parent
    const BoxNode& node = tree.nodes()[n];
    std::uint32_t& of_node = sorted.of_node[n];
    if (!node.is_leaf()) {
      if (sorted.of_node[n + 1] == sorted.of_node[node.right]) of_node = sorted.of_node[n + 1];
      continue;
    }
    const std::span<const std::uint32_t> items(sorted.of_triangle.data() + node.first, node.count);
    const bool are_equal = std::all_of(items.begin(), items.end(),
                                       [&](std::uint32_t group) { return group == items[0]; });
    if (are_equal) of_node = items[0];
  }
}

void compare(const SortedTriangles& sorted, const SelfIntersectionOptions& options,
             std::vector<Findings>& findings) {
  const std::vector<NodePair> tasks =
      upper_node_pairs(sorted.tree.nodes(), [&](NodePair pair) { return sorted.may_meet(pair); });
  const std::size_t before = findings.size();
  findings.resize(before + tasks.size(), Findings(options.most_pairs));
  SharedProgress progress(options.progress, tasks.size());
  std::atomic<std::size_t> count = 0;
  parallel_for(tasks.size(), [&](std::size_t i) {
    if (count <= options.enough)
      TreeComparison(sorted, progress, findings[before + i]).run(tasks[i]);
    count += findings[before + i].count();
    progress.done();
  });
}

}  // namespace meshrepair::internal
