// SPDX-License-Identifier: MIT
// Not coplanar: what they have in common lies in the line of the two planes, and each end of it is
// a corner of one in the other, or where a side of one, not in the other's plane, passes the other.
#include "meeting_places.h"

#include <base/assert.h>
#include <exact/double_predicates.h>

namespace meshrepair::internal {
namespace {

using Signs = std::array<int, 3>;

std::size_t next(std::size_t k) { return k == 2 ? 0 : k + 1; }

MeetingPoint swapped(const MeetingPoint& p) { return {p.in_b, p.in_a}; }

Signs sides(const TriangleCorners& plane, const TriangleCorners& of) {
  const PlaneFilter filter(plane[0], plane[1], plane[2]);
  Signs signs{};
  for (std::size_t k = 0; k < 3; ++k) {
    signs[k] = filter.side(of[k]);
    if (signs[k] == 0) signs[k] = exact_orientation(plane[0], plane[1], plane[2], of[k]);
  }
  return signs;
}

bool is_apart(const Signs& s) { return s[0] != 0 && s[0] == s[1] && s[1] == s[2]; }

// From three signs, of what lies left of each side, 0 on it; nothing outside.
bool place_by_turns(const Signs& turns, Place& place) {
  bool left = false, right = false;
  std::size_t zeros = 0, zero = 0, other = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    left |= turns[k] > 0;
    right |= turns[k] < 0;
    if (turns[k] == 0) {
      ++zeros;
      zero = k;
    } else {
      other = k;
    }
  }
  if (left && right) return false;
  if (zeros == 0) {
    place = Place::inside();
  } else if (zeros == 1) {
    place = Place::side(zero);
  } else {
    // On two sides: where they meet, which is opposite to the third one.
    place = Place::corner(next(next(other)));
  }
  return true;
}

// Where the line through p and q, which is not in the plane of `t`, passes it.
bool place_of_line(const Vec3d& p, const Vec3d& q, const TriangleCorners& t, Place& place) {
  Signs turns{};
  for (std::size_t k = 0; k < 3; ++k) turns[k] = orientation(p, q, t[k], t[next(k)]);
  return place_by_turns(turns, place);
}

// Of a point in the plane of `t`, seen along an axis.
bool place_in_plane(const Vec3d& p, const TriangleCorners& t, int axis, Place& place) {
  Signs turns{};
  for (std::size_t k = 0; k < 3; ++k) turns[k] = orientation_along(axis, t[k], t[next(k)], p);
  return place_by_turns(turns, place);
}

// Adds the ends that a's corners and sides make in b. `signs`: on which sides of b's plane the
// corners lie.
template <class Add>
void add_ends(const TriangleCorners& a, const Signs& signs, const TriangleCorners& b, Add add) {
  Place place = Place::inside();
  int axis = -1;
  for (std::size_t k = 0; k < 3; ++k) {
    if (signs[k] == 0) {
      if (axis < 0) axis = projection_axis(b[0], b[1], b[2]);
      if (place_in_plane(a[k], b, axis, place)) add(MeetingPoint{Place::corner(k), place});
    } else if (signs[k] * signs[next(k)] < 0) {
      if (place_of_line(a[k], a[next(k)], b, place)) add(MeetingPoint{Place::side(k), place});
    }
  }
}

// Of two sides in one plane: do they cross between their ends?
bool cross_in_plane(const Vec3d& p, const Vec3d& q, const Vec3d& r, const Vec3d& s, int axis) {
  return orientation_along(axis, p, q, r) * orientation_along(axis, p, q, s) < 0 &&
         orientation_along(axis, r, s, p) * orientation_along(axis, r, s, q) < 0;
}

// Is p strictly between q and r, with which it is in a line?
bool is_between(const Vec3d& p, const Vec3d& q, const Vec3d& r) {
  for (Eigen::Index k = 0; k < 3; ++k) {
    if (q[k] != r[k]) return (q[k] < p[k] && p[k] < r[k]) || (r[k] < p[k] && p[k] < q[k]);
  }
  return false;
}

// What side k of `a` has in common with `b`, as seen from a.
CommonSegment side_in_plane(const TriangleCorners& a, std::size_t k, const TriangleCorners& b,
                            int axis) {
  CommonSegment common;
  const Vec3d& p = a[k];
  const Vec3d& q = a[next(k)];
  Place place = Place::inside();
  if (place_in_plane(p, b, axis, place)) common.add({Place::corner(k), place});
  if (place_in_plane(q, b, axis, place)) common.add({Place::corner(next(k)), place});
  for (std::size_t j = 0; j < 3; ++j) {
    if (orientation_along(axis, p, q, b[j]) == 0 && is_between(b[j], p, q)) {
      common.add({Place::side(k), Place::corner(j)});
    }
    if (cross_in_plane(p, q, b[j], b[next(j)], axis)) {
      common.add({Place::side(k), Place::side(j)});
    }
  }
  return common;
}

}  // namespace

void CommonSegment::add(const MeetingPoint& point) {
  for (std::size_t i = 0; i < count; ++i) {
    if (ends[i] == point) return;
  }
  MESHREPAIR_ASSERT(count < 2);
  ends[count++] = point;
}

TriangleMeeting meet_triangles(const TriangleCorners& a, const TriangleCorners& b) {
  TriangleMeeting meeting;
  const Signs of_b = sides(a, b);
  if (is_apart(of_b)) return meeting;
  if (of_b == Signs{}) {
    meeting.coplanar = true;
    const int axis = projection_axis(a[0], a[1], a[2]);
    for (std::size_t k = 0; k < 3; ++k) {
      meeting.sides_of_a[k] = side_in_plane(a, k, b, axis);
      meeting.sides_of_b[k] = side_in_plane(b, k, a, axis);
      for (MeetingPoint& p : meeting.sides_of_b[k].ends) p = swapped(p);
    }
    return meeting;
  }
  const Signs of_a = sides(b, a);
  if (is_apart(of_a)) return meeting;
  add_ends(a, of_a, b, [&](const MeetingPoint& p) { meeting.across.add(p); });
  add_ends(b, of_b, a, [&](const MeetingPoint& p) { meeting.across.add(swapped(p)); });
  return meeting;
}

}  // namespace meshrepair::internal
