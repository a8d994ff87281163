// SPDX-License-Identifier: MIT
// Boxes around a common corner always meet, so triangles that share one are compared by their
// directions from it.
#include "compare_triangles.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <base/parallel.h>
#include <base/shared_progress.h>
#include <check/box_tree.h>
#include <check/internal/triangle_pair.h>

#include "crossing_sheets.h"
#include "findings.h"
#include "spatial_comparison.h"
#include "tree_comparison.h"
#include "triangle_hubs.h"

namespace meshrepair::internal {
namespace {

// Enough that looking up takes longer than handing out the task.
constexpr std::size_t kLookUpsPerTask = 4096;

// The triangles of one group, to be compared with each other.
struct Group {
  std::vector<CornerTriangle> triangles;
  std::vector<std::uint32_t> ids;
};

// Calls visit(hub, group) for those with the same hub, in the order of the hubs.
template <class TriangleAt, class Visit>
void visit_groups(const TriangleAt& triangle_at, std::span<const std::uint32_t> ids,
                  const std::vector<std::uint32_t>& hubs, Visit visit) {
  std::vector<std::uint32_t> items;
  for (std::uint32_t i = 0; i < hubs.size(); ++i) {
    if (hubs[i] != kNoHub) items.push_back(i);
  }
  std::stable_sort(items.begin(), items.end(),
                   [&](std::uint32_t i, std::uint32_t j) { return hubs[i] < hubs[j]; });
  Group group;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::uint32_t hub = hubs[items[i]];
    group.triangles.push_back(triangle_at(items[i]));
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
    boxes.push_back(direction_across(edge, triangle));
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
    boxes.push_back(directions_from(hub, triangle));
  }
  const std::vector<std::uint32_t> second = find_second_hubs(hub, group.triangles);
  const BoxTree tree(boxes);
  SortedTriangles sorted(group.triangles, boxes, group.ids, tree);
  sorted.leave_out_hubs(second);
  compare(sorted, options, findings);
  const auto triangle_at = [&](std::uint32_t i) { return group.triangles[i]; };
  visit_groups(triangle_at, group.ids, second, [&](std::uint32_t end, const Group& around) {
    compare_around_edge(around, {hub, end}, options, findings);
  });
}

SelfIntersections with_left_out(SelfIntersections result, std::size_t degenerate,
                                std::size_t not_finite) {
  result.degenerate = degenerate;
  result.not_finite = not_finite;
  return result;
}

// Unless enough has been found.
template <class TriangleAt>
void compare_around_hubs(const TriangleAt& triangle_at, std::span<const std::uint32_t> ids,
                         const std::vector<std::uint32_t>& hubs,
                         const SelfIntersectionOptions& options, std::vector<Findings>& findings) {
  const bool any =
      std::any_of(findings.begin(), findings.end(), [](const Findings& f) { return f.any(); });
  if (options.only_whether && any) return;
  CancelOnly quiet(options.progress);
  SelfIntersectionOptions around_hubs = options;
  around_hubs.progress = &quiet;
  visit_groups(triangle_at, ids, hubs, [&](std::uint32_t hub, const Group& group) {
    compare_around_hub(group, hub, around_hubs, findings);
  });
}

}  // namespace

SelfIntersections compare_all(const SoupCorners& corners, const SelfIntersectionOptions& options) {
  TriangleList list(corners);
  const std::size_t degenerate = list.degenerate(), not_finite = list.not_finite();
  const BoxTree tree(list.boxes());
  const std::vector<std::uint32_t> hubs = find_hubs(list);
  std::vector<Findings> findings;
  std::optional<std::vector<MeetingPair>> in_space;
  if (boxes_tell_little(list, hubs, tree)) {
    in_space = compare_in_space(list, hubs, options.progress);
  }
  if (in_space) {
    findings.emplace_back(options.most_pairs);
    for (const auto& [a, b, meeting] : *in_space) {
      findings.back().add(list.ids()[a], list.ids()[b], meeting);
    }
    const auto triangle_at = [&](std::uint32_t i) { return list.triangle(i); };
    compare_around_hubs(triangle_at, list.ids(), hubs, options, findings);
  } else {
    SortedTriangles sorted(std::move(list), tree);
    sorted.leave_out_hubs(hubs);
    compare(sorted, options, findings);
    const auto triangle_at = [&](std::uint32_t i) { return sorted.triangles[i]; };
    compare_around_hubs(triangle_at, sorted.ids, sorted.hub, options, findings);
  }
  return with_left_out(gather(findings, options.most_pairs), degenerate, not_finite);
}

SelfIntersections compare_with(const SoupCorners& corners, const TriangleList& list,
                               const SelfIntersectionOptions& options) {
  const TriangleSoup& soup = corners.soup();
  const BoxTree tree(list.boxes());
  if (tree.nodes().empty()) return with_left_out({}, list.degenerate(), list.not_finite());
  const SortedTriangles sorted(list, tree);
  std::vector<char> is_listed(soup.triangles.size(), 0);
  for (const std::uint32_t id : list.ids()) is_listed[id] = 1;
  const std::size_t count = soup.triangles.size();
  const std::size_t tasks = tasks_of(count, kLookUpsPerTask);
  std::vector<Findings> findings(tasks, Findings(options.most_pairs));
  SharedProgress progress(options.progress, tasks);
  parallel_tasks(count, kLookUpsPerTask,
                 [&](std::size_t task, std::size_t first, std::size_t last) {
                   LookUp look_up(sorted, options.nearness, progress, findings[task]);
                   for (std::size_t t = first; t < last; ++t) {
                     const auto id = static_cast<std::uint32_t>(t);
                     Box box = box_of(soup, id);
                     box.widen(options.nearness);
                     if (!look_up.may_meet_any(box)) continue;
                     CornerTriangle triangle;
                     if (corners.fetch(id, triangle) != Fetched::usable) continue;
                     look_up.run(id, triangle, box, is_listed[t] != 0);
                   }
                   progress.done();
                 });
  return with_left_out(gather(findings, options.most_pairs), list.degenerate(), list.not_finite());
}

void add_crossing_sheets(const SoupCorners& corners, std::span<const std::uint32_t> among,
                         const SelfIntersectionOptions& options, SelfIntersections& result) {
  std::vector<Pair> pairs = find_crossing_sheets(corners);
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

}  // namespace meshrepair::internal
