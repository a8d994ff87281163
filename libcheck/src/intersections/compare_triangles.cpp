// SPDX-License-Identifier: MIT
// Boxes around a common corner always meet, so triangles that share one are compared by their
// directions from it.
#include "compare_triangles.h"

#include <algorithm>
#include <utility>

#include <check/box_tree.h>
#include <check/internal/triangle_pair.h>

#include "crossing_sheets.h"
#include "findings.h"
#include "height_fields.h"
#include "tree_comparison.h"
#include "triangle_hubs.h"

namespace meshrepair::internal {
namespace {

// Of each triangle of the soup whether its pairs are asked for; empty: all are.
using Listed = std::span<const char>;

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
    if (hubs[i] != kNone) items.push_back(i);
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
void compare_around_edge(const Group& group, std::array<std::uint32_t, 2> edge, Listed is_listed,
                         const SelfIntersectionOptions& options, std::vector<Findings>& findings) {
  std::vector<Box> boxes;
  boxes.reserve(group.triangles.size());
  for (const CornerTriangle& triangle : group.triangles) {
    boxes.push_back(direction_across(edge, triangle));
  }
  const BoxTree tree(boxes);
  SortedTriangles sorted(group.triangles, boxes, group.ids, tree);
  if (!is_listed.empty()) sorted.leave_out_unlisted(is_listed);
  compare(sorted, options, findings);
}

// All boxes around a hub meet there; but two triangles with a common corner that meet elsewhere do
// so in some direction from it.
void compare_around_hub(const Group& group, std::uint32_t hub, Listed is_listed,
                        const SelfIntersectionOptions& options, std::vector<Findings>& findings) {
  std::vector<Box> boxes;
  boxes.reserve(group.triangles.size());
  for (const CornerTriangle& triangle : group.triangles) {
    boxes.push_back(directions_from(hub, triangle));
  }
  const std::vector<std::uint32_t> second = find_second_hubs(hub, group.triangles);
  const BoxTree tree(boxes);
  SortedTriangles sorted(group.triangles, boxes, group.ids, tree);
  sorted.leave_out(second);
  if (!is_listed.empty()) sorted.leave_out_unlisted(is_listed);
  compare(sorted, options, findings);
  const auto triangle_at = [&](std::uint32_t i) { return group.triangles[i]; };
  visit_groups(triangle_at, group.ids, second, [&](std::uint32_t end, const Group& around) {
    compare_around_edge(around, {hub, end}, is_listed, options, findings);
  });
}

SelfIntersections with_left_out(SelfIntersections result, std::size_t degenerate,
                                std::size_t not_finite) {
  result.degenerate = degenerate;
  result.not_finite = not_finite;
  return result;
}

// Unless enough has been found.
void compare_around_hubs(const SortedTriangles& sorted, const std::vector<std::uint32_t>& hubs,
                         Listed is_listed, const SelfIntersectionOptions& options,
                         std::vector<Findings>& findings) {
  std::size_t count = 0;
  for (const Findings& f : findings) count += f.count();
  if (count > options.enough) return;
  CancelOnly quiet(options.progress);
  SelfIntersectionOptions around_hubs = options;
  around_hubs.progress = &quiet;
  visit_groups([&](std::uint32_t i) { return sorted.triangles[i]; }, sorted.ids, hubs,
               [&](std::uint32_t hub, const Group& group) {
                 compare_around_hub(group, hub, is_listed, around_hubs, findings);
               });
}

SelfIntersections compare(TriangleList list, Listed is_listed,
                          const SelfIntersectionOptions& options) {
  const BoxTree tree(list.boxes());
  // Around hubs, directions tell what meets, not what is near.
  const std::vector<std::uint32_t> hubs =
      options.nearness == 0 ? find_hubs(list) : std::vector<std::uint32_t>();
  std::vector<std::uint32_t> fields;
  const auto tell_little = [&] {
    return boxes_tell_little(tree, list.boxes(), [&](std::uint32_t i, std::uint32_t j) {
      return have_one_group(hubs, i, j) || have_one_group(fields, i, j);
    });
  };
  const bool are_long = tell_little();
  if (are_long || may_have_height_fields(list, tree)) fields = find_height_fields(list, tree);
  const bool use_oriented = are_long && tell_little();
  SortedTriangles sorted(std::move(list), tree);
  sorted.look_within(options.nearness);
  sorted.leave_out(hubs);
  sorted.leave_out(fields);
  if (!is_listed.empty()) sorted.leave_out_unlisted(is_listed);
  if (use_oriented) sorted.use_oriented_boxes();
  std::vector<Findings> findings;
  compare(sorted, options, findings);
  if (!hubs.empty()) {
    compare_around_hubs(sorted, sorted.left_out_groups.front().of_triangle, is_listed, options,
                        findings);
  }
  return gather(findings, options.most_pairs);
}

}  // namespace

SelfIntersections compare_all(const SoupCorners& corners, const SelfIntersectionOptions& options) {
  SelfIntersectionOptions all = options;
  all.nearness = 0;
  TriangleList list(corners);
  const std::size_t degenerate = list.degenerate(), not_finite = list.not_finite();
  return with_left_out(compare(std::move(list), {}, all), degenerate, not_finite);
}

SelfIntersections compare_with(const SoupCorners& corners, const TriangleList& list,
                               const SelfIntersectionOptions& options) {
  if (list.size() == 0) return with_left_out({}, list.degenerate(), list.not_finite());
  std::vector<char> is_listed(corners.soup().triangles.size(), 0);
  for (const std::uint32_t id : list.ids()) is_listed[id] = 1;
  return with_left_out(compare(TriangleList(corners), is_listed, options), list.degenerate(),
                       list.not_finite());
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
