// A point is inside a closed part if a ray from it passes the part an odd number of times. The rays
// run along the z axis, each from a corner of a triangle of the part in question.
// Other parts may touch that corner, where inside and outside meet: see column_ray.h.
#include "part_nesting.h"

#include <algorithm>

#include <base/parallel.h>
#include <base/shared_progress.h>
#include <check/box_tree.h>
#include <check/triangle_list.h>

#include "column_ray.h"

namespace meshrepair::internal {
namespace {

constexpr std::size_t kPartsPerTask = 64;

class RayCaster {
 public:
  RayCaster(const TriangleSoup& soup, std::span<const std::uint32_t> part_of)
      : soup_(soup), part_of_(part_of) {
    std::vector<Box> boxes;
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
      if (part_of[t] == kNoPart) continue;
      triangles_.push_back(t);
      boxes.push_back(box_of(soup, t));
    }
    tree_.emplace_back(boxes);
  }

  // The number of parts around a triangle, but for its own.
  std::uint32_t parts_around(std::uint32_t inner, std::vector<std::uint32_t>& passed,
                             SharedProgress& progress) const {
    const auto& corners = soup_.triangles[inner];
    const RayStart start = RayStart::in(soup_, corners);
    const std::uint32_t own = part_of_[inner];
    passed.clear();
    std::size_t steps = 0;
    visit_column(tree_.front(), start.corner, [&](std::uint32_t item) {
      const std::uint32_t triangle = triangles_[item];
      if (++steps % 4096 == 0) progress.poll();
      const auto& t = soup_.triangles[triangle];
      if (part_of_[triangle] == own) return;
      if (passed_upward(soup_.points[t[0]], soup_.points[t[1]], soup_.points[t[2]], start) != 0) {
        passed.push_back(part_of_[triangle]);
      }
    });
    std::sort(passed.begin(), passed.end());
    std::uint32_t around = 0;
    for (std::size_t i = 0; i < passed.size();) {
      const auto end = std::upper_bound(passed.begin(), passed.end(), passed[i]) - passed.begin();
      around += (static_cast<std::size_t>(end) - i) % 2 == 1;
      i = static_cast<std::size_t>(end);
    }
    return around;
  }

 private:
  const TriangleSoup& soup_;
  std::span<const std::uint32_t> part_of_;
  std::vector<std::uint32_t> triangles_;
  std::vector<BoxTree> tree_;  // one, made once its boxes are known
};

std::vector<std::uint32_t> first_triangles(std::span<const std::uint32_t> part_of,
                                           std::size_t parts) {
  std::vector<std::uint32_t> first(parts, kNoPart);
  for (std::uint32_t t = 0; t < part_of.size(); ++t) {
    if (part_of[t] != kNoPart && first[part_of[t]] == kNoPart) first[part_of[t]] = t;
  }
  return first;
}

}  // namespace

std::vector<std::uint32_t> nesting_depths(const TriangleSoup& soup,
                                          std::span<const std::uint32_t> part_of, std::size_t parts,
                                          ProgressObserver* progress) {
  std::vector<std::uint32_t> depths(parts, 0);
  if (parts < 2) return depths;
  const RayCaster caster(soup, part_of);
  const std::vector<std::uint32_t> first = first_triangles(part_of, parts);
  SharedProgress shared(progress, tasks_of(parts, kPartsPerTask));
  parallel_tasks(parts, kPartsPerTask, [&](std::size_t, std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t> passed;
    for (std::size_t part = begin; part < end; ++part) {
      depths[part] = caster.parts_around(first[part], passed, shared);
    }
    shared.done();
  });
  return depths;
}

}  // namespace meshrepair::internal
