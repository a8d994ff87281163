// SPDX-License-Identifier: MIT
#include "arranged_points.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <base/assert.h>
#include <base/ids.h>
#include <base/parallel.h>
#include <exact/predicates.h>

namespace meshrepair::internal {
namespace {

// Sizes: a component of the direction is below 2^109, of a normal below 2^54, so the sum of three
// products is below 2^165.
int sign_of_dot(const std::array<std::int64_t, 3>& normal, const Direction& direction) {
  return (Int256::product(normal[0], direction[0]) + Int256::product(normal[1], direction[1]) +
          Int256::product(normal[2], direction[2]))
      .sign();
}

int order_on_lattice(const Direction& direction, const GridPoint& p, const GridPoint& q) {
  const std::array<std::int64_t, 3> step = {std::int64_t{q.x} - p.x, std::int64_t{q.y} - p.y,
                                            std::int64_t{q.z} - p.z};
  return sign_of_dot(step, direction);
}

std::size_t longest_axis(const Direction& d) {
  const auto size = [&](std::size_t k) { return d[k] < 0 ? -d[k] : d[k]; };
  std::size_t axis = size(1) > size(0) ? 1 : 0;
  if (size(2) > size(axis)) axis = 2;
  return axis;
}

}  // namespace

Direction direction_of(const Plane& a, const Plane& b) {
  const auto& m = a.normal;
  const auto& n = b.normal;
  return {Int128{m[1]} * n[2] - Int128{m[2]} * n[1], Int128{m[2]} * n[0] - Int128{m[0]} * n[2],
          Int128{m[0]} * n[1] - Int128{m[1]} * n[0]};
}

int order_along(const Direction& direction, const Point& p, const Point& q,
                const PlaneTable& planes) {
  const std::size_t axis = longest_axis(direction);
  const double step = q.position[axis] - p.position[axis];
  const double error = static_cast<double>(p.error) + static_cast<double>(q.error);
  // The difference is off by both errors, and rounded itself.
  if (std::abs(step) > 1.001 * error + 0x1p-20) {
    return (step > 0) == (direction[axis] > 0) ? 1 : -1;
  }
  if (p.is_lattice() && q.is_lattice()) {
    return order_on_lattice(direction, p.lattice(), q.lattice());
  }
  if (p.is_lattice()) return -order_along(direction, q, p, planes);
  // One of the planes of p passes the line.
  for (const PlaneId id : p.planes) {
    const int along = sign_of_dot(planes[id].normal, direction);
    if (along != 0) return along * side(q, id, planes);
  }
  MESHREPAIR_ASSERT(false);
  return 0;
}

ArrangedPoints::ArrangedPoints(const CutSet& cut, std::vector<PointName> names)
    : cut_(cut), first_new_(cut.soup().points.size()), names_(std::move(names)), same_(0) {
  std::erase_if(names_, [](const PointName& n) { return n.is_corner(); });
  parallel_sort(names_.begin(), names_.end(), std::less<>());
  names_.erase(std::unique(names_.begin(), names_.end()), names_.end());
  points_.resize(names_.size());
  parallel_for(names_.size(), [&](std::size_t i) { points_[i] = meet_of(names_[i]); });
}

void ArrangedPoints::add_triples(std::vector<TripleName> names) {
  triples_ = std::move(names);
  parallel_sort(triples_.begin(), triples_.end(), std::less<>());
  triples_.erase(std::unique(triples_.begin(), triples_.end()), triples_.end());
  points_.resize(names_.size() + triples_.size());
  parallel_for(triples_.size(), [&](std::size_t i) {
    const auto& [a, b, c] = triples_[i];
    points_[names_.size() + i] =
        meet(cut_.planes(), cut_.plane(a), cut_.plane(b), cut_.plane(c), {});
  });
  same_ = DisjointSets(size());
}

Point ArrangedPoints::meet_of(const PointName& name) const {
  const PlaneTable& planes = cut_.planes();
  const auto& [beside, across] = cut_.planes_of(name.edge());
  if (name.is_on_triangle()) return meet(planes, beside, across, cut_.plane(name.other()), {});
  // One of the other edge's planes does not contain this one.
  const auto& ends = cut_.ends(name.edge());
  const GridPoint& a = cut_.soup().grid_points[PointId(ends[0])];
  const GridPoint& b = cut_.soup().grid_points[PointId(ends[1])];
  const auto& others = cut_.planes_of(name.other());
  const auto contains = [&](PlaneId id) {
    return side(a, planes[id]) == 0 && side(b, planes[id]) == 0;
  };
  return meet(planes, beside, across, contains(others[0]) ? others[1] : others[0], {});
}

std::uint32_t ArrangedPoints::find(const PointName& name) const {
  if (name.is_corner()) return name.point();
  const auto found = std::lower_bound(names_.begin(), names_.end(), name);
  if (found == names_.end() || *found != name) return kNone;
  return static_cast<std::uint32_t>(first_new_ + static_cast<std::size_t>(found - names_.begin()));
}

std::uint32_t ArrangedPoints::find(const TripleName& name) const {
  const auto found = std::lower_bound(triples_.begin(), triples_.end(), name);
  if (found == triples_.end() || *found != name) return kNone;
  return static_cast<std::uint32_t>(first_new_ + names_.size() +
                                    static_cast<std::size_t>(found - triples_.begin()));
}

bool ArrangedPoints::sound() const {
  return std::none_of(points_.begin(), points_.end(), [](const Point& p) { return p.is_loose(); });
}

Point ArrangedPoints::at(std::uint32_t point) const {
  if (point >= first_new_) return points_[point - first_new_];
  return lattice_point(cut_.soup().grid_points[PointId(point)]);
}

void ArrangedPoints::settle() {
  settled_.resize(points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    settled_[i] = same_.root(static_cast<std::uint32_t>(first_new_ + i));
  }
}

}  // namespace meshrepair::internal
