// SPDX-License-Identifier: MIT
// Seidel's incremental linear programming, for a point instead of an optimum.
//
// Idea: hold a point that is on the inner side of all planes so far, a vertex of three of them. If
// the next plane cuts it off and there still is such a point, then there is one on that plane: the
// way from the old point to it passes through. So look on the plane, with the planes so far, in the
// same manner, and there on lines. On a line each plane bounds one end, and the ends are compared.
//
// Volume: every plane n.x + d > 0 is moved inwards to n.x + d >= e, by the same infinitely small e.
// A region has volume if and only if the moved planes leave anything. A vertex x0 + e x1 is given
// by three moved planes; the sign of n.x + d - e there is that of n.x0 + d, and where this is 0
// that of n.x1 - 1. Where both are 0 the vertex is on the plane, so inside.
#include <cmath>
#include <limits>

#include <exact/predicates.h>
#include <exact/region_volume.h>

#include "predicates_internal.h"

namespace meshrepair {
namespace {

constexpr std::size_t kBoxPlanes = 6;
constexpr std::size_t kNoBound = std::numeric_limits<std::size_t>::max();
// Within this reach signed_distance() is as near as it says.
constexpr double kGridReach = 0x1p26;
// Of a determinant of three unit vectors, see meet_approximately().
constexpr double kTurnError = 0x1p-46;

// The move, for all planes alike.
Plane moved_part(Plane plane) {
  plane.offset = -1;
  return plane;
}

Plane box_plane(std::size_t axis, bool upper, std::int64_t at) {
  std::array<std::int64_t, 3> normal{};
  normal[axis] = upper ? -1 : 1;
  return make_plane(normal, Int128{upper ? at : -at});
}

}  // namespace

Plane turned(const Plane& plane) {
  Plane other = plane;
  for (std::int64_t& n : other.normal) n = -n;
  for (double& n : other.unit) n = -n;
  other.offset = -other.offset;
  other.unit_offset = -other.unit_offset;
  return other;
}

RegionVolume::RegionVolume(const GridBox& box)
    : planes_{box_plane(0, false, box.low.x), box_plane(0, true, box.high.x),
              box_plane(1, false, box.low.y), box_plane(1, true, box.high.y),
              box_plane(2, false, box.low.z), box_plane(2, true, box.high.z)} {}

bool RegionVolume::has_volume(std::span<const Plane> planes) {
  planes_.resize(kBoxPlanes);
  planes_.insert(planes_.end(), planes.begin(), planes.end());
  Vertex point = vertex(0, 2, 4);
  for (Index i = kBoxPlanes; i < planes_.size(); ++i) {
    if (!is_inside(point, i) && !solve_on_plane(i, point)) return false;
  }
  return true;
}

// With the planes before h.
bool RegionVolume::solve_on_plane(Index h, Vertex& found) {
  if (!start_on_plane(h, found)) return false;
  for (Index i = kBoxPlanes; i < h; ++i) {
    if (!is_inside(found, i) && !solve_on_line(h, i, found)) return false;
  }
  return true;
}

// A corner of the polygon in which the plane cuts the box.
bool RegionVolume::start_on_plane(Index h, Vertex& found) {
  for (Index a = 0; a < kBoxPlanes; ++a) {
    for (Index b = (a / 2 + 1) * 2; b < kBoxPlanes; ++b) {
      if (turn(h, a, b) == 0) continue;
      const Index third = 2 * (3 - a / 2 - b / 2);
      const Vertex corner = vertex(h, a, b);
      if (!is_inside(corner, third) || !is_inside(corner, third + 1)) continue;
      found = corner;
      return true;
    }
  }
  return false;
}

// With the planes before g, on the common line of h and g.
bool RegionVolume::solve_on_line(Index h, Index g, Vertex& found) {
  Index lower = kNoBound, upper = kNoBound;
  Vertex low, high;
  for (Index k = 0; k < g; ++k) {
    const int direction = turn(h, g, k);
    if (direction == 0) {
      if (!passes_parallel(h, g, k)) return false;
    } else if (direction > 0) {
      if (lower != kNoBound && is_inside(low, k)) continue;
      lower = k;
      low = vertex(h, g, k);
    } else {
      if (upper != kNoBound && is_inside(high, k)) continue;
      upper = k;
      high = vertex(h, g, k);
    }
  }
  // The box bounds every line at both ends; if there is none, h and g are parallel.
  if (lower == kNoBound || upper == kNoBound || !is_inside(low, upper)) return false;
  found = high;
  return true;
}

// The line keeps its distance to the plane.
bool RegionVolume::passes_parallel(Index h, Index g, Index parallel) {
  for (Index b = 0; b < kBoxPlanes; b += 2) {
    if (turn(h, g, b) != 0) return is_inside(vertex(h, g, b), parallel);
  }
  return false;
}

RegionVolume::Vertex RegionVolume::vertex(Index a, Index b, Index c) const {
  const auto near = internal::meet_approximately(planes_[a], planes_[b], planes_[c]);
  Vertex made{{a, b, c}, near.position, near.error};
  for (const double x : made.position) {
    if (!(std::abs(x) < kGridReach)) made.error = std::numeric_limits<double>::infinity();
  }
  return made;
}

// Sign of the determinant of three normals.
int RegionVolume::turn(Index a, Index b, Index c) const {
  const auto& u = planes_[a].unit;
  const auto& v = planes_[b].unit;
  const auto& w = planes_[c].unit;
  const double det = u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) +
                     u[2] * (v[0] * w[1] - v[1] * w[0]);
  if (det > kTurnError) return 1;
  if (det < -kTurnError) return -1;
  return internal::meet_exactly(planes_[a], planes_[b], planes_[c]).denominator.sign();
}

bool RegionVolume::is_inside(const Vertex& at, Index plane) {
  ++looked_at_;
  const auto& [a, b, c] = at.planes;
  if (plane == a || plane == b || plane == c) return true;
  if (at.error < kGridReach) {
    const double distance = signed_distance(at.position, planes_[plane]);
    const double bound = kDistanceError + 1.7321 * at.error;
    if (distance > bound) return true;
    if (distance < -bound) return false;
  }
  ++decided_exactly_;
  const auto exact = internal::meet_exactly(planes_[a], planes_[b], planes_[c]);
  const int sign = internal::side_exactly(exact, planes_[plane]);
  if (sign != 0) return sign > 0;
  const auto moved = internal::meet_exactly(moved_part(planes_[a]), moved_part(planes_[b]),
                                            moved_part(planes_[c]));
  return internal::side_exactly(moved, moved_part(planes_[plane])) >= 0;
}

}  // namespace meshrepair
