// A point is inside a closed part if a ray from it passes the part an odd number of times. The rays
// run along the z axis; so that none meets an edge, each starts a step of e along x and e^2 along y
// beside its point, for an e that is smaller than any positive number: a turn that is 0 is decided
// by that step, which makes each turn consistent with all others.
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

// The turn from a over b to p seen along z, p being moved by the step. 0 only if a and b are one.
int turn(const Vec3d& a, const Vec3d& b, const Vec3d& p) {
  const int sign = orientation_along(2, a, b, p);
  if (sign != 0) return sign;
  const int by_x = sign_of_difference(a.y(), b.y());
  return by_x != 0 ? by_x : sign_of_difference(b.x(), a.x());
}

bool is_passed_above(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& p) {
  const int upward = turn(a, b, p);
  if (upward == 0 || turn(b, c, p) != upward || turn(c, a, p) != upward) return false;
  return orientation(a, b, c, p) == -upward;
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

  // The number of parts around a point, but for the point's own.
  std::uint32_t parts_around(const Vec3d& p, std::uint32_t own, std::vector<std::uint32_t>& passed,
                             SharedProgress& progress) const {
    passed.clear();
    std::size_t steps = 0;
    visit_column(p, [&](std::uint32_t triangle) {
      if (++steps % 4096 == 0) progress.poll();
      const auto& t = soup_.triangles[triangle];
      if (part_of_[triangle] == own) return;
      if (is_passed_above(soup_.points[t[0]], soup_.points[t[1]], soup_.points[t[2]], p)) {
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
    const BoxTree& tree = tree_.front();
    if (tree.nodes().empty()) return;
    std::vector<std::uint32_t> stack(1, 0);
    while (!stack.empty()) {
      const std::uint32_t n = stack.back();
      stack.pop_back();
      const BoxNode& node = tree.nodes()[n];
      if (!reaches_column(node.box, p)) continue;
      if (node.is_leaf()) {
        for (const std::uint32_t i : tree.order().subspan(node.first, node.count)) {
          visit(triangles_[i]);
        }
      } else {
        stack.push_back(node.right);
        stack.push_back(n + 1);
      }
    }
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
      const Vec3d& p = soup.points[soup.triangles[first[part]][0]];
      depths[part] = caster.parts_around(p, static_cast<std::uint32_t>(part), passed, shared);
    }
    shared.done();
  });
  return depths;
}

}  // namespace meshrepair::internal
