// SPDX-License-Identifier: MIT
#include "collapse_guard.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include <exact/double_predicates.h>
#include <mesh/mesh_parts.h>

namespace meshrepair::internal {
namespace {

// A triangle may be turned by about so much, as a cosine: farther, and it stands on its edge.
constexpr double kMostTurned = 0.2;

// The shape of a triangle, 1 for three equal sides and 0 for none: below this it is a needle, which
// a collapse must not make of a better one.
constexpr double kNeedle = 0.001;

// Of the volume of a part, what one collapse may change.
constexpr double kMostVolume = 0.25;

double shape_of(double doubled_area, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const double sides = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  return sides > 0 ? 2 * std::sqrt(3.0) * doubled_area / sides : 0;
}

bool contains(const Box& box, const Vec3d& p) {
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = p[static_cast<Eigen::Index>(k)];
    if (x < box.low[k] || x > box.high[k]) return false;
  }
  return true;
}

}  // namespace

CollapseGuard::CollapseGuard(const CollapsibleMesh& mesh, const std::vector<Vec3d>& points,
                             MeshParts parts)
    : mesh_(mesh),
      points_(points),
      places_(find_places(points)),
      part_of_(std::move(parts.of_triangle)),
      looked_at_by_(mesh.triangles().size(), 0) {
  const auto& triangles = mesh.triangles();
  some_point_.resize(parts.count);
  for (std::uint32_t t = 0; t < triangles.size(); ++t) some_point_[part_of_[t]] = triangles[t][0];
  const UnitScale as_it_is({});
  for (const PartSize& size : part_sizes(points, triangles, part_of_, parts.count, as_it_is)) {
    volume_.push_back(6 * size.volume);
  }
  rebuild();
}

Box CollapseGuard::box_of(std::uint32_t triangle) const {
  Box box;
  for (const std::uint32_t p : mesh_.triangles()[triangle]) box.add(points_[p]);
  return box;
}

void CollapseGuard::rebuild() {
  std::vector<std::uint32_t> left;
  std::vector<Box> boxes;
  for (std::uint32_t t = 0; t < mesh_.triangles().size(); ++t) {
    if (!mesh_.is_left(t)) continue;
    left.push_back(t);
    boxes.push_back(box_of(t));
  }
  boxes_.build(left, boxes, mesh_.triangles().size());
}

Refusal CollapseGuard::refusal(const Collapse& collapse) {
  if (folds(collapse)) return Refusal::fold;
  if (swallows_rest(collapse)) return Refusal::meeting;
  if (!is_height_field(collapse) && fan_meets_itself()) return Refusal::meeting;
  if (fan_touches_itself(collapse)) return Refusal::meeting;
  return meets_others(collapse) ? Refusal::meeting : Refusal::none;
}

// Makes the new fan, too.
bool CollapseGuard::folds(const Collapse& collapse) {
  fan_.clear();
  fan_boxes_.clear();
  double least_before = 1, least_after = 1;
  const Vec3d& place = collapse.place;
  for (const auto& t : collapse.fan) {
    const Vec3d &next = points_[t.next], &last = points_[t.last], &old = old_place(collapse, t);
    const Vec3d before = (next - old).cross(last - old), after = (next - place).cross(last - place);
    const double size_before = before.norm(), size_after = after.norm();
    if (!(before.dot(after) > kMostTurned * size_before * size_after)) return true;
    least_before = std::min(least_before, shape_of(size_before, old, next, last));
    least_after = std::min(least_after, shape_of(size_after, place, next, last));
    const int axis = projection_axis(place, next, last);
    if (axis < 0) return true;
    fan_.push_back({{place, next, last},
                    {places_.place[collapse.to], places_.place[t.next], places_.place[t.last]},
                    axis});
    Box& box = fan_boxes_.emplace_back();
    for (const Vec3d& p : fan_.back().at) box.add(p);
  }
  return least_after < std::min(kNeedle, least_before);
}

// Seen along the axis that it faces most, its triangles turn once around the place, all the same
// way: then none lies over another.
bool CollapseGuard::is_height_field(const Collapse& collapse) const {
  Vec3d normal = Vec3d::Zero();
  for (const CornerTriangle& t : fan_) normal += (t.at[1] - t.at[0]).cross(t.at[2] - t.at[0]);
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  const int way = normal[axis] > 0 ? 1 : -1;
  const int up = axis == 0 ? 2 : axis - 1;  // of the two others, as y is to x along z
  const double level = collapse.place[up];
  int times = 0;
  for (const CornerTriangle& t : fan_) {
    if (orientation_along(axis, t.at[0], t.at[1], t.at[2]) != way) return false;
    const double from = t.at[1][up], to = t.at[2][up];
    times += way > 0 ? (from <= level && to > level) : (to <= level && from > level);
  }
  return times == 1;
}

bool CollapseGuard::fan_meets_itself() const {
  for (std::size_t i = 0; i < fan_.size(); ++i) {
    for (std::size_t k = i + 1; k < fan_.size(); ++k) {
      if (meeting_of(fan_[i], fan_[k]) != Meeting::apart) return true;
    }
  }
  return false;
}

// Tetrahedra between the old fan and the place, and one for each triangle that goes.
bool CollapseGuard::swallows_rest(const Collapse& collapse) {
  double moved = 0;
  swept_ = 0;
  const auto sweep = [&](const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    const double volume = (collapse.place - a).dot((b - a).cross(c - a));
    swept_ += volume;
    moved += std::abs(volume);
  };
  for (const auto& t : collapse.fan) {
    sweep(old_place(collapse, t), points_[t.next], points_[t.last]);
  }
  for (const std::uint32_t t : collapse.gone) {
    const auto& [a, b, c] = mesh_.triangles()[t];
    sweep(points_[a], points_[b], points_[c]);
  }
  return moved > kMostVolume * std::abs(volume_[part_of_[collapse.gone[0]]]);
}

bool CollapseGuard::meets_others(const Collapse& collapse) {
  ++question_;
  for (const auto& t : collapse.fan) looked_at_by_[t.triangle] = question_;
  for (const std::uint32_t t : collapse.gone) looked_at_by_[t] = question_;
  Box swept;
  for (const Box& box : fan_boxes_) swept.add(box);
  swept.add(points_[collapse.from]);
  swept.add(points_[collapse.to]);
  const std::uint32_t own = part_of_[collapse.gone[0]];
  bool meets = false;
  boxes_.visit(swept, [&](std::uint32_t t) {
    if (meets || looked_at_by_[t] == question_ || !mesh_.is_left(t)) return;
    const std::uint32_t part = part_of_[t];
    meets = meets_fan(t) || touches_fan(t, collapse) ||
            (part != own && contains(swept, points_[some_point_[part]]));
  });
  return meets;
}

bool CollapseGuard::meets_fan(std::uint32_t triangle) {
  const auto& corners = mesh_.triangles()[triangle];
  const Box box = box_of(triangle);
  CornerTriangle other;
  bool is_ready = false;
  for (std::size_t i = 0; i < fan_.size(); ++i) {
    if (!fan_boxes_[i].meets(box)) continue;
    if (!std::exchange(is_ready, true)) {
      for (std::size_t k = 0; k < 3; ++k) {
        other.at[k] = points_[corners[k]];
        other.corner[k] = places_.place[corners[k]];
      }
      other.axis = projection_axis(other.at[0], other.at[1], other.at[2]);
    }
    if (meeting_of(fan_[i], other) != Meeting::apart) return true;
  }
  return false;
}

// Around the place, two ends of edges in one place.
bool CollapseGuard::fan_touches_itself(const Collapse& collapse) const {
  for (std::size_t i = 0; i < collapse.fan.size(); ++i) {
    const std::uint32_t point = collapse.fan[i].next;
    if (!is_held(point)) continue;
    for (std::size_t k = i + 1; k < collapse.fan.size(); ++k) {
      if (places_.place[collapse.fan[k].next] == places_.place[point]) return true;
    }
  }
  return false;
}

// Has the triangle an edge in the same place as one of the fan, but with points of its own? Then
// they touch along it, and what they bound may cross there without any two triangles that do.
bool CollapseGuard::touches_fan(std::uint32_t triangle, const Collapse& collapse) const {
  const auto& corners = mesh_.triangles()[triangle];
  const auto held = [&](std::uint32_t p) { return is_held(p); };
  if (std::none_of(corners.begin(), corners.end(), held)) return false;
  return std::any_of(collapse.fan.begin(), collapse.fan.end(), [&](const auto& t) {
    if (is_held(collapse.to) && t.was_of_to) return false;  // it stays as it is
    int places = 0, points = 0;
    for (const std::uint32_t p : {collapse.to, t.next, t.last}) {
      for (const std::uint32_t q : corners) {
        places += places_.place[p] == places_.place[q];
        points += p == q;
      }
    }
    return places > 1 && points < places;
  });
}

void CollapseGuard::note_made(const Collapse& collapse) {
  const std::uint32_t part = part_of_[collapse.gone[0]];
  volume_[part] += swept_;
  if (some_point_[part] == collapse.from) some_point_[part] = collapse.to;
  for (std::size_t i = 0; i < collapse.fan.size(); ++i) {
    boxes_.change(collapse.fan[i].triangle, fan_boxes_[i]);
  }
  boxes_.note_gone(2);
  if (boxes_.is_worn()) rebuild();
}

}  // namespace meshrepair::internal
