// The triangles' boxes are put into a tree, and the tree is compared with itself: two nodes whose
// boxes meet, then their children, down to pairs of triangles, which are tested exactly. The upper
// part of that walk becomes a list of tasks, the same whatever the number of threads. With a list
// of triangles the tree holds these alone, and all the others are looked up in it. Where boxes tell
// little, spatial_comparison.h takes over.
#include <algorithm>
#include <atomic>
#include <optional>

#include <tbb/parallel_for.h>

#include <base/shared_progress.h>
#include <check/box_tree.h>
#include <check/self_intersections.h>
#include <check/triangle_list.h>
#include <check/triangle_pair.h>

#include "crossing_sheets.h"
#include "spatial_comparison.h"
#include "triangle_hubs.h"

namespace meshrepair {
namespace {

using internal::CornerTriangle;
using internal::Meeting;
using internal::TriangleList;
using Pair = std::array<std::uint32_t, 2>;

// Enough that all threads end at about the same time.
constexpr std::size_t kTasks = 1024;
constexpr std::size_t kLookUpsPerTask = 4096;
// A few hundred microseconds of work.
constexpr std::size_t kStepsPerQuestion = 4096;

// What one task has found: counts of all, and the lowest `most` pairs.
class Findings {
 public:
  explicit Findings(std::size_t most) : most_(most) {}

  void add(std::uint32_t a, std::uint32_t b, Meeting meeting) {
    ++counts_[static_cast<std::size_t>(meeting)];
    pairs_.push_back({std::min(a, b), std::max(a, b)});
    if (pairs_.size() > most_ && pairs_.size() - most_ >= most_ + 64) keep_lowest();
  }

  [[nodiscard]] bool any() const {
    return std::any_of(counts_.begin(), counts_.end(), [](std::size_t count) { return count > 0; });
  }

  void add_to(SelfIntersections& result) const {
    result.pairs.insert(result.pairs.end(), pairs_.begin(), pairs_.end());
    result.crossing += counts_[static_cast<std::size_t>(Meeting::crossing)];
    result.touching += counts_[static_cast<std::size_t>(Meeting::touching)];
    result.coplanar += counts_[static_cast<std::size_t>(Meeting::coplanar)];
  }

 private:
  void keep_lowest() {
    const auto middle = pairs_.begin() + static_cast<std::ptrdiff_t>(most_);
    std::nth_element(pairs_.begin(), middle, pairs_.end());
    pairs_.resize(most_);
  }

  std::size_t most_;
  std::vector<Pair> pairs_;
  std::array<std::size_t, 4> counts_{};
};

SelfIntersections gather(const std::vector<Findings>& tasks, std::size_t most) {
  SelfIntersections result;
  for (const Findings& findings : tasks) findings.add_to(result);
  std::sort(result.pairs.begin(), result.pairs.end());
  if (result.pairs.size() > most) result.pairs.resize(most);
  result.count = result.crossing + result.touching + result.coplanar;
  return result;
}

// Two nodes to be compared, or, if they are one, a node with itself.
struct NodePair {
  std::uint32_t a;
  std::uint32_t b;
};

// The triangles of a list in the order of a tree's leaves, so that what is compared lies together.
struct SortedTriangles {
  SortedTriangles(std::span<const CornerTriangle> given, std::span<const Box> given_boxes,
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
  SortedTriangles(const TriangleList& list, const BoxTree& box_tree)
      : SortedTriangles(list.triangles(), list.boxes(), list.ids(), box_tree) {}

  // Leaves out pairs of triangles with the same hub. `hubs` are those of the triangles as given.
  void leave_out_hubs(const std::vector<std::uint32_t>& hubs) {
    for (const std::uint32_t item : tree.order()) hub.push_back(hubs[item]);
    node_hub.assign(tree.nodes().size(), internal::kNoHub);
    for (std::size_t n = tree.nodes().size(); n-- > 0;) {  // children come behind their parent
      const BoxNode& node = tree.nodes()[n];
      if (!node.is_leaf()) {
        if (node_hub[n + 1] == node_hub[node.right]) node_hub[n] = node_hub[n + 1];
        continue;
      }
      const auto first = hub.begin() + node.first;
      if (std::all_of(first, first + node.count, [&](std::uint32_t h) { return h == *first; })) {
        node_hub[n] = *first;
      }
    }
  }

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

  const BoxTree& tree;
  std::vector<CornerTriangle> triangles;
  std::vector<Box> boxes;
  std::vector<std::uint32_t> ids;
  std::vector<std::uint32_t> hub, node_hub;  // empty: nothing is left out
};

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
  void run(std::uint32_t id, const CornerTriangle& triangle, const Box& box, bool is_in_tree) {
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

 private:
  [[nodiscard]] Meeting meeting_with(const CornerTriangle& a, const CornerTriangle& b) const {
    const Meeting meeting = meeting_of(a, b);
    if (meeting != Meeting::apart || nearness_ == 0) return meeting;
    return nearly_overlap(a, b, nearness_) ? Meeting::coplanar : Meeting::apart;
  }

  const SortedTriangles& sorted_;
  std::span<const BoxNode> nodes_;
  double nearness_;
  SharedProgress& progress_;
  Findings& findings_;
  std::vector<std::uint32_t> stack_;
  std::size_t steps_ = 0;
};

void compare(const SortedTriangles& sorted, const SelfIntersectionOptions& options,
             std::vector<Findings>& findings) {
  const std::vector<NodePair> tasks = make_tasks(sorted);
  const std::size_t before = findings.size();
  findings.resize(before + tasks.size(), Findings(options.most_pairs));
  SharedProgress progress(options.progress, tasks.size());
  std::atomic<bool> enough = false;
  tbb::parallel_for(std::size_t{0}, tasks.size(), [&](std::size_t i) {
    if (!enough) TreeComparison(sorted, progress, findings[before + i]).run(tasks[i]);
    if (options.only_whether && findings[before + i].any()) enough = true;
    progress.done();
  });
}

// The triangles of one group, to be compared with each other.
struct Group {
  std::vector<CornerTriangle> triangles;
  std::vector<std::uint32_t> ids;
};

// Calls visit(hub, group) for those with the same hub, in the order of the hubs.
template <class Visit>
void visit_groups(std::span<const CornerTriangle> triangles, std::span<const std::uint32_t> ids,
                  const std::vector<std::uint32_t>& hubs, Visit visit) {
  std::vector<std::uint32_t> items;
  for (std::uint32_t i = 0; i < hubs.size(); ++i) {
    if (hubs[i] != internal::kNoHub) items.push_back(i);
  }
  std::stable_sort(items.begin(), items.end(),
                   [&](std::uint32_t i, std::uint32_t j) { return hubs[i] < hubs[j]; });
  Group group;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::uint32_t hub = hubs[items[i]];
    group.triangles.push_back(triangles[items[i]]);
    group.ids.push_back(ids[items[i]]);
    if (i + 1 < items.size() && hubs[items[i + 1]] == hub) continue;
    visit(hub, group);
    group = {};
  }
}

// Two triangles with a common edge that meet elsewhere leave it in one direction.
void compare_around_edge(const Group& group, std::array<std::uint32_t, 2> edge,
                         const SelfIntersectionOptions& options, std::vector<Findings>& findings) {
  std::vector<Box> boxes;
  boxes.reserve(group.triangles.size());
  for (const CornerTriangle& triangle : group.triangles) {
    boxes.push_back(internal::direction_across(edge, triangle));
  }
  const BoxTree tree(boxes);
  compare(SortedTriangles(group.triangles, boxes, group.ids, tree), options, findings);
}

// All boxes around a hub meet there; but two triangles with a common corner that meet elsewhere do
// so in some direction from it.
void compare_around_hub(const Group& group, std::uint32_t hub,
                        const SelfIntersectionOptions& options, std::vector<Findings>& findings) {
  std::vector<Box> boxes;
  boxes.reserve(group.triangles.size());
  for (const CornerTriangle& triangle : group.triangles) {
    boxes.push_back(internal::directions_from(hub, triangle));
  }
  const std::vector<std::uint32_t> second = internal::find_second_hubs(hub, group.triangles);
  const BoxTree tree(boxes);
  SortedTriangles sorted(group.triangles, boxes, group.ids, tree);
  sorted.leave_out_hubs(second);
  compare(sorted, options, findings);
  visit_groups(group.triangles, group.ids, second, [&](std::uint32_t end, const Group& around) {
    compare_around_edge(around, {hub, end}, options, findings);
  });
}

SelfIntersections compare_all(const TriangleList& list, const SelfIntersectionOptions& options) {
  const BoxTree tree(list.boxes());
  const std::vector<std::uint32_t> hubs = internal::find_hubs(list.triangles());
  std::vector<Findings> findings;
  std::optional<std::vector<internal::MeetingPair>> in_space;
  if (internal::boxes_tell_little(list.triangles(), list.boxes(), hubs, tree)) {
    in_space = internal::compare_in_space(list.triangles(), hubs, options.progress);
  }
  if (in_space) {
    findings.emplace_back(options.most_pairs);
    for (const auto& [a, b, meeting] : *in_space) {
      findings.back().add(list.ids()[a], list.ids()[b], meeting);
    }
  } else {
    SortedTriangles sorted(list, tree);
    sorted.leave_out_hubs(hubs);
    compare(sorted, options, findings);
  }
  const bool any =
      std::any_of(findings.begin(), findings.end(), [](const Findings& f) { return f.any(); });
  if (options.only_whether && any) return gather(findings, options.most_pairs);
  CancelOnly quiet(options.progress);
  SelfIntersectionOptions around_hubs = options;
  around_hubs.progress = &quiet;
  visit_groups(list.triangles(), list.ids(), hubs, [&](std::uint32_t hub, const Group& group) {
    compare_around_hub(group, hub, around_hubs, findings);
  });
  return gather(findings, options.most_pairs);
}

SelfIntersections compare_with(const TriangleSoup& soup, const internal::SoupCorners& corners,
                               const TriangleList& list, const SelfIntersectionOptions& options) {
  const BoxTree tree(list.boxes());
  if (tree.nodes().empty()) return {};
  const SortedTriangles sorted(list, tree);
  std::vector<char> is_listed(soup.triangles.size(), 0);
  for (const std::uint32_t id : list.ids()) is_listed[id] = 1;
  const std::size_t count = soup.triangles.size();
  const std::size_t tasks = (count + kLookUpsPerTask - 1) / kLookUpsPerTask;
  std::vector<Findings> findings(tasks, Findings(options.most_pairs));
  SharedProgress progress(options.progress, tasks);
  tbb::parallel_for(std::size_t{0}, tasks, [&](std::size_t task) {
    LookUp look_up(sorted, options.nearness, progress, findings[task]);
    const std::size_t end = std::min(count, (task + 1) * kLookUpsPerTask);
    for (std::size_t t = task * kLookUpsPerTask; t < end; ++t) {
      const auto id = static_cast<std::uint32_t>(t);
      Box box = internal::box_of(soup, id);
      box.widen(options.nearness);
      if (!look_up.may_meet_any(box)) continue;
      CornerTriangle triangle;
      if (corners.fetch(id, triangle) != internal::Fetched::usable) continue;
      look_up.run(id, triangle, box, is_listed[t] != 0);
    }
    progress.done();
  });
  return gather(findings, options.most_pairs);
}

// Of those in which one of `among` is, unless that is empty. Pairs that meet elsewhere, too, are
// there already.
void add_crossing_sheets(const internal::SoupCorners& corners, std::span<const std::uint32_t> among,
                         const SelfIntersectionOptions& options, SelfIntersections& result) {
  std::vector<Pair> pairs = internal::find_crossing_sheets(corners);
  if (!among.empty()) {
    std::vector<char> is_listed(corners.soup().triangles.size(), 0);
    for (const std::uint32_t id : among) is_listed[id] = 1;
    std::erase_if(pairs, [&](const Pair& pair) {
      return is_listed[pair[0]] == 0 && is_listed[pair[1]] == 0;
    });
  }
  std::erase_if(pairs, [&](const Pair& pair) {
    return std::binary_search(result.pairs.begin(), result.pairs.end(), pair);
  });
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  if (pairs.empty()) return;
  result.count += pairs.size();
  result.crossing += pairs.size();
  const auto middle = static_cast<std::ptrdiff_t>(result.pairs.size());
  result.pairs.insert(result.pairs.end(), pairs.begin(), pairs.end());
  std::inplace_merge(result.pairs.begin(), result.pairs.begin() + middle, result.pairs.end());
  result.pairs.resize(std::min(result.pairs.size(), options.most_pairs));
}

}  // namespace

SelfIntersections self_intersections(const TriangleSoup& soup,
                                     const SelfIntersectionOptions& options) {
  const internal::SoupCorners corners(soup, options.weld);
  const TriangleList list(corners);
  SelfIntersections result = compare_all(list, options);
  const bool is_enough = options.only_whether && result.count > 0;
  if (options.weld && !is_enough) add_crossing_sheets(corners, {}, options, result);
  result.degenerate = list.degenerate();
  result.not_finite = list.not_finite();
  return result;
}

SelfIntersections self_intersections(const TriangleSoup& soup, std::span<const std::uint32_t> among,
                                     const SelfIntersectionOptions& options) {
  const internal::SoupCorners corners(soup, options.weld);
  const TriangleList list(corners, among);
  SelfIntersections result = compare_with(soup, corners, list, options);
  if (options.weld && list.size() > 0) add_crossing_sheets(corners, list.ids(), options, result);
  result.degenerate = list.degenerate();
  result.not_finite = list.not_finite();
  return result;
}

}  // namespace meshrepair
