// SPDX-License-Identifier: MIT
// A point is inside a closed part if a ray from it passes the part an odd number of times. The rays
// run along the z axis, each from a corner of a triangle of the part in question.
// Other parts may touch that corner, where inside and outside meet: see column_ray.h.
#include "part_nesting.h"

#include <algorithm>

#include <base/parallel.h>
#include <base/shared_progress.h>
#include <check/box_tree.h>
#include <check/internal/triangle_list.h>

#include "column_ray.h"

namespace meshrepair::internal {
namespace {

constexpr std::size_t kTrianglesPerTask = 16384;

// After so many, what cancels out is dropped.
constexpr std::size_t kTasksAtOnce = 64;
constexpr std::size_t kPassingsAtOnce = 1 << 17;

// That a ray from inside one part passes another one.
struct Passing {
  std::uint32_t inner;
  std::uint32_t outer;

  bool operator==(const Passing& other) const {
    return inner == other.inner && outer == other.outer;
  }
  bool operator<(const Passing& other) const {
    return inner != other.inner ? inner < other.inner : outer < other.outer;
  }
};

// Sorts them, and leaves one of those that are there an odd number of times.
void keep_odd(std::vector<Passing>& passings) {
  std::sort(passings.begin(), passings.end());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < passings.size();) {
    std::size_t end = i;
    while (end < passings.size() && passings[end] == passings[i]) ++end;
    if ((end - i) % 2 == 1) passings[kept++] = passings[i];
    i = end;
  }
  passings.resize(kept);
}

std::vector<std::uint32_t> first_triangles(std::span<const std::uint32_t> part_of,
                                           std::size_t parts) {
  std::vector<std::uint32_t> first(parts, kNoPart);
  for (std::uint32_t t = 0; t < part_of.size(); ++t) {
    if (part_of[t] != kNoPart && first[part_of[t]] == kNoPart) first[part_of[t]] = t;
  }
  return first;
}

// One ray for each part. There are far fewer of them than triangles, so they are in the tree.
class RayCaster {
 public:
  RayCaster(const TriangleSoup& soup, std::span<const std::uint32_t> part_of, std::size_t parts)
      : soup_(soup), part_of_(part_of), tree_({}) {
    for (const std::uint32_t t : first_triangles(part_of, parts)) {
      starts_.push_back(RayStart::in(soup, soup.triangles[t]));
      boxes_.emplace_back().add(starts_.back().corner);
    }
    tree_ = BoxTree(boxes_);
  }

  // Of these triangles.
  [[nodiscard]] std::vector<Passing> find_passings(std::size_t first, std::size_t end) const {
    std::vector<Passing> passings;
    std::size_t room = kPassingsAtOnce;
    for (std::size_t t = first; t < end; ++t) {
      if (passings.size() >= room) {
        keep_odd(passings);
        room = std::max(room, 2 * passings.size());
      }
      const std::uint32_t outer = part_of_[t];
      if (outer == kNoPart) continue;
      const auto& corners = soup_.triangles[t];
      const Box box = box_of(soup_, static_cast<std::uint32_t>(t));
      tree_.visit([&](const Box& starts) { return may_pass(starts, box); },
                  [&](std::uint32_t inner) {
                    if (inner == outer || !may_pass(boxes_[inner], box)) return;
                    if (passed_upward(soup_.points[corners[0]], soup_.points[corners[1]],
                                      soup_.points[corners[2]], starts_[inner]) != 0) {
                      passings.push_back({inner, outer});
                    }
                  });
    }
    keep_odd(passings);
    return passings;
  }

 private:
  // Whether a ray that starts in the box may pass a triangle's.
  static bool may_pass(const Box& starts, const Box& triangle) {
    return starts.low[0] <= triangle.high[0] && triangle.low[0] <= starts.high[0] &&
           starts.low[1] <= triangle.high[1] && triangle.low[1] <= starts.high[1] &&
           starts.low[2] <= triangle.high[2];
  }

  const TriangleSoup& soup_;
  std::span<const std::uint32_t> part_of_;
  std::vector<RayStart> starts_;  // of each part
  std::vector<Box> boxes_;        // of where they start
  BoxTree tree_;
};

}  // namespace

PartNesting find_nesting(const TriangleSoup& soup, std::span<const std::uint32_t> part_of,
                         std::size_t parts, ProgressObserver* progress) {
  PartNesting nesting{std::vector<std::uint32_t>(parts, 0),
                      std::vector<std::uint32_t>(parts, kNoPart)};
  if (parts < 2) return nesting;
  const RayCaster caster(soup, part_of, parts);
  const std::size_t count = soup.triangles.size();
  const std::size_t tasks = tasks_of(count, kTrianglesPerTask);
  SharedProgress shared(progress, tasks);
  std::vector<Passing> all;
  for (std::size_t first = 0; first < tasks; first += kTasksAtOnce) {
    std::vector<std::vector<Passing>> passings(std::min(kTasksAtOnce, tasks - first));
    parallel_for(passings.size(), [&](std::size_t i) {
      const std::size_t begin = (first + i) * kTrianglesPerTask;
      passings[i] = caster.find_passings(begin, std::min(count, begin + kTrianglesPerTask));
      shared.done();
    });
    for (const auto& some : passings) all.insert(all.end(), some.begin(), some.end());
    keep_odd(all);
  }
  for (const Passing& passing : all) ++nesting.depth[passing.inner];
  for (const Passing& passing : all) {
    std::uint32_t& around = nesting.around[passing.inner];
    if (around == kNoPart || nesting.depth[passing.outer] > nesting.depth[around]) {
      around = passing.outer;
    }
  }
  return nesting;
}

}  // namespace meshrepair::internal
