// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include <Eigen/Geometry>

#include <check/internal/fault_counter.h>
#include <check/internal/nearby_intersections.h>
#include <check/internal/triangle_list.h>
#include <exact/double_predicates.h>

namespace meshrepair::internal {
namespace {

bool covers(const Box& all, const Box& part) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(all.low[k] <= part.low[k] && part.high[k] <= all.high[k])) return false;
  }
  return true;
}

}  // namespace

BoxesAround::BoxesAround(const TriangleSoup& mesh, std::vector<Box> places)
    : mesh_(mesh), places_(std::move(places)) {
  take(triangles_near(mesh_, places_, 0));
}

void BoxesAround::find(const Box& box, std::vector<std::uint32_t>& found) {
  if (!has_all_ && !is_at_a_place(box)) take_all();
  tree_->visit([&](const Box& other) { return other.meets(box); },
               [&](std::uint32_t i) {
                 if (boxes_[i].meets(box)) found.push_back(triangles_[i]);
               });
}

bool BoxesAround::is_at_a_place(const Box& box) const {
  return std::any_of(places_.begin(), places_.end(),
                     [&](const Box& place) { return covers(place, box); });
}

void BoxesAround::take(std::vector<std::uint32_t> triangles) {
  triangles_ = std::move(triangles);
  boxes_.resize(triangles_.size());
  for (std::size_t i = 0; i < boxes_.size(); ++i) boxes_[i] = box_of(mesh_, triangles_[i]);
  tree_.emplace(boxes_);
}

void BoxesAround::take_all() {
  std::vector<std::uint32_t> all(mesh_.triangles.size());
  std::iota(all.begin(), all.end(), 0u);
  take(std::move(all));
  has_all_ = true;
}

namespace {

// Of a sum of three products, as a share of the largest coordinate.
constexpr double kHeightRounding = 1e-14;

// Whether more than this lies between the two, along the normal of one of them. Any direction would
// do for that, so it may be rounded.
bool lie_apart(const CornerTriangle& a, const CornerTriangle& b, const CornerTriangle& of,
               double distance) {
  const Vec3d normal = (of.at[1] - of.at[0]).cross(of.at[2] - of.at[0]).stableNormalized();
  if (!normal.allFinite()) return false;
  double low_a = 0, high_a = 0, farthest = 0;  // seen from the first corner of a
  for (const Vec3d& p : a.at) {
    const double height = normal.dot(p - a.at[0]);
    low_a = std::min(low_a, height);
    high_a = std::max(high_a, height);
    farthest = std::max(farthest, (p - a.at[0]).cwiseAbs().maxCoeff());
  }
  double low_b = std::numeric_limits<double>::infinity(), high_b = -low_b;
  for (const Vec3d& p : b.at) {
    const double height = normal.dot(p - a.at[0]);
    low_b = std::min(low_b, height);
    high_b = std::max(high_b, height);
    farthest = std::max(farthest, (p - a.at[0]).cwiseAbs().maxCoeff());
  }
  const double margin = distance + kHeightRounding * farthest;
  return low_b - high_a > margin || low_a - high_b > margin;
}

}  // namespace

FaultCounter::FaultCounter(const TriangleSoup& mesh, double reach, std::vector<Box> places)
    : points_(mesh.points), reach_(reach), at_first_(mesh, std::move(places)) {}

void FaultCounter::add_changed(const std::vector<std::uint32_t>& triangles) {
  changed_.insert(changed_.end(), triangles.begin(), triangles.end());
}

std::ptrdiff_t FaultCounter::start(const EditableMesh& mesh,
                                   std::span<const std::uint32_t> triangles,
                                   std::optional<double> moved) {
  find_others(mesh, triangles);
  std::vector<TriangleCorners> corners;
  corners.reserve(triangles.size());
  for (const std::uint32_t t : triangles) corners.push_back(mesh.triangles()[t]);
  others_near_.clear();
  if (moved) find_others_near(corners, *moved);
  return count(corners);
}

void FaultCounter::find_others(const EditableMesh& mesh, std::span<const std::uint32_t> triangles) {
  Box around;
  for (const std::uint32_t t : triangles) {
    for (const std::uint32_t p : mesh.triangles()[t]) around.add(points_[p]);
  }
  around.widen(reach_);
  near_.clear();
  at_first_.find(around, near_);
  near_.insert(near_.end(), changed_.begin(), changed_.end());
  std::sort(near_.begin(), near_.end());
  near_.erase(std::unique(near_.begin(), near_.end()), near_.end());
  others_.clear();
  for (const std::uint32_t t : near_) {
    const bool is_asked_for = std::find(triangles.begin(), triangles.end(), t) != triangles.end();
    if (mesh.is_left(t) && !is_asked_for) add(mesh.triangles()[t], others_);
  }
  all_others_.resize(others_.size());
  std::iota(all_others_.begin(), all_others_.end(), 0u);
}

void FaultCounter::find_others_near(const std::vector<TriangleCorners>& triangles, double moved) {
  asked_.clear();
  for (const TriangleCorners& corners : triangles) {
    std::vector<std::uint32_t>& near = others_near_.emplace_back();
    // One without area has no normal, and may get one.
    if (!add(corners, asked_)) {
      near = all_others_;
      continue;
    }
    const CornerTriangle& a = asked_.back().triangle;
    Box around = asked_.back().box;
    around.widen(moved);
    for (const std::uint32_t i : all_others_) {
      if (!around.meets(others_[i].box)) continue;
      const CornerTriangle& b = others_[i].triangle;
      if (!lie_apart(a, b, a, moved) && !lie_apart(a, b, b, moved)) near.push_back(i);
    }
  }
}

std::ptrdiff_t FaultCounter::count(const std::vector<TriangleCorners>& triangles,
                                   std::ptrdiff_t most) {
  std::ptrdiff_t faults = 0;
  asked_.clear();
  asked_place_.clear();
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    if (triangles[i] == kGone) continue;
    if (add(triangles[i], asked_)) {
      asked_place_.push_back(i);
    } else {
      ++faults;
    }
  }
  for (std::size_t i = 0; i < asked_.size() && faults <= most; ++i) {
    asked_[i].triangle.corner = {0, 1, 2};
    for (std::size_t k = i + 1; k < asked_.size(); ++k) {
      faults += meet(asked_[i], asked_[k]) ? 1 : 0;
    }
    const auto& others = others_near_.empty() ? all_others_ : others_near_[asked_place_[i]];
    for (std::size_t k = 0; k < others.size() && faults <= most; ++k) {
      faults += meet(asked_[i], others_[others[k]]) ? 1 : 0;
    }
  }
  return faults;
}

// False for one without area.
bool FaultCounter::add(const TriangleCorners& corners, std::vector<Placed>& to) const {
  const Vec3d &a = points_[corners[0]], &b = points_[corners[1]], &c = points_[corners[2]];
  const int axis = projection_axis(a, b, c);
  if (axis < 0) return false;
  Placed placed{{{a, b, c}, {0, 1, 2}, axis}, {}};
  for (const Vec3d& p : placed.triangle.at) placed.box.add(p);
  to.push_back(placed);
  return true;
}

// Numbers the corners of b by those of a in the same places.
bool FaultCounter::meet(const Placed& a, Placed& b) {
  if (!a.box.meets(b.box)) return false;
  for (std::uint32_t k = 0; k < 3; ++k) {
    std::uint32_t& corner = b.triangle.corner[k];
    corner = 0;
    while (corner < 3 && a.triangle.at[corner] != b.triangle.at[k]) ++corner;
    if (corner == 3) corner += k;
  }
  return meeting_of(a.triangle, b.triangle) != Meeting::apart;
}

}  // namespace meshrepair::internal
