// A point is inside a closed part if a ray from it passes the part an odd number of times. The rays
// run along the z axis, each from a corner of a triangle of the part in question.
//
// Other parts may touch that corner, where inside and outside meet, and a ray may meet an edge. So
// it starts beside the corner, by four steps, each smaller by far than the one before and smaller
// than any positive number: along the triangle's two sides, which leads into its interior, where
// nothing touches it, then along x and y. A turn that is 0 is decided by the first step that turns
// it, which makes each turn consistent with all others.
#include "part_nesting.h"

#include <algorithm>

#include <tbb/parallel_for.h>

#include <bsp/double_predicates.h>
#include <bsp/shared_progress.h>
#include <extract/box_tree.h>

#include "triangle_list.h"

namespace meshrepair::internal {
namespace {

constexpr std::size_t kPartsPerTask = 64;

int sign_of_difference(double a, double b) { return static_cast<int>(a > b) - (a < b); }

// Where a ray starts: beside `corner`, into the triangle that has it and the other two.
struct Start {
  Vec3d corner, second, third;
};

// The turn from a over b to the start seen along z. 0 only if a and b are one. What a step along a
// side adds is the turn to the side's end, as the corner itself adds nothing.
int turn(const Vec3d& a, const Vec3d& b, const Start& start) {
  for (const Vec3d* p : {&start.corner, &start.second, &start.third}) {
    const int sign = orientation_along(2, a, b, *p);
    if (sign != 0) return sign;
  }
  const int by_x = sign_of_difference(a.y(), b.y());
  return by_x != 0 ? by_x : sign_of_difference(b.x(), a.x());
}

// 0 only if the two triangles lie in one plane.
int side_of_plane(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Start& start) {
  for (const Vec3d* p : {&start.corner, &start.second, &start.third}) {
    const int sign = orientation(a, b, c, *p);
    if (sign != 0) return sign;
  }
  return 0;
}

bool is_passed_above(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Start& start) {
  const int upward = turn(a, b, start);
  if (upward == 0 || turn(b, c, start) != upward || turn(c, a, start) != upward) return false;
  return side_of_plane(a, b, c, start) == -upward;
}

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
    const Start start{soup_.points[corners[0]], soup_.points[corners[1]], soup_.points[corners[2]]};
    const std::uint32_t own = part_of_[inner];
    passed.clear();
    std::size_t steps = 0;
    visit_column(start.corner, [&](std::uint32_t triangle) {
      if (++steps % 4096 == 0) progress.poll();
      const auto& t = soup_.triangles[triangle];
      if (part_of_[triangle] == own) return;
      if (is_passed_above(soup_.points[t[0]], soup_.points[t[1]], soup_.points[t[2]], start)) {
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
  static bool reaches_column(const Box& box, const Vec3d& p) {
    return box.low[0] <= p.x() && p.x() <= box.high[0] && box.low[1] <= p.y() &&
           p.y() <= box.high[1] && p.z() <= box.high[2];
  }

  template <class Visit>
  void visit_column(const Vec3d& p, Visit visit) const {
    tree_.front().visit([&](const Box& box) { return reaches_column(box, p); },
                        [&](std::uint32_t i) { visit(triangles_[i]); });
  }

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
  const std::size_t tasks = (parts + kPartsPerTask - 1) / kPartsPerTask;
  SharedProgress shared(progress, tasks);
  tbb::parallel_for(std::size_t{0}, tasks, [&](std::size_t task) {
    std::vector<std::uint32_t> passed;
    const std::size_t end = std::min(parts, (task + 1) * kPartsPerTask);
    for (std::size_t part = task * kPartsPerTask; part < end; ++part) {
      depths[part] = caster.parts_around(first[part], passed, shared);
    }
    shared.done();
  });
  return depths;
}

}  // namespace meshrepair::internal
