// SPDX-License-Identifier: MIT
// By the number of corners that the two share:
//
//   0  Different planes: if the triangles meet they do so in a segment or a point, each end of
//   which
//      is a point where an edge of one, not in the plane of the other, meets the other. So it is
//      enough to try those edges. One plane: they meet unless a side of one has the other beyond
//      it.
//   1  What they have in common is convex and holds the shared corner; if it holds another point,
//      go from the corner through it: the way leaves one of the two first, at the side opposite to
//      the corner. So one of the two opposite sides meets the other triangle.
//   2  Beyond the edge they meet only if they are folded onto each other: in one plane, on one
//   side. 3  They are equal.
#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include <check/internal/triangle_pair.h>
#include <exact/double_predicates.h>

namespace meshrepair::internal {
namespace {

using Signs = std::array<int, 3>;

std::size_t next(std::size_t k) { return k == 2 ? 0 : k + 1; }

struct SharedCorners {
  std::size_t count = 0;
  std::array<std::size_t, 3> in_a{}, in_b{};
};

SharedCorners shared_corners(const CornerTriangle& a, const CornerTriangle& b) {
  SharedCorners shared;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (a.corner[i] != b.corner[j]) continue;
      shared.in_a[shared.count] = i;
      shared.in_b[shared.count] = j;
      ++shared.count;
    }
  }
  return shared;
}

// The sides of the plane of `t` on which the corners of `other` lie, 0 where doubles cannot tell.
// `skip` is a shared corner, 3 if there is none.
Signs filtered_sides(const CornerTriangle& t, const CornerTriangle& other, std::size_t skip) {
  const PlaneFilter plane(t.at[0], t.at[1], t.at[2]);
  Signs signs{};
  for (std::size_t k = 0; k < 3; ++k) {
    if (k != skip) signs[k] = plane.side(other.at[k]);
  }
  return signs;
}

// Those that doubles do not tell.
void complete_sides(Signs& signs, const CornerTriangle& t, const CornerTriangle& other,
                    std::size_t skip) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (k == skip || signs[k] != 0) continue;
    signs[k] = exact_orientation(t.at[0], t.at[1], t.at[2], other.at[k]);
  }
}

// All but the skipped corner lie strictly on one side.
bool is_one_sided(const Signs& signs, std::size_t skip) {
  const int first = signs[skip == 0 ? 1 : 0];
  for (std::size_t k = 0; k < 3; ++k) {
    if (k != skip && signs[k] != first) return false;
  }
  return first != 0;
}

bool is_on_both_sides(const Signs& signs) {
  bool above = false, below = false;
  for (const int sign : signs) {
    above |= sign > 0;
    below |= sign < 0;
  }
  return above && below;
}

// Does the line through p and q, which is not in the plane of `t`, pass through `t`?
bool line_meets(const Vec3d& p, const Vec3d& q, const CornerTriangle& t) {
  bool left = false, right = false;
  for (std::size_t k = 0; k < 3; ++k) {
    const int sign = orientation(p, q, t.at[k], t.at[next(k)]);
    left |= sign > 0;
    right |= sign < 0;
    if (left && right) return false;
  }
  return true;
}

// Does the edge from corner i to corner j of `from` meet `t`, on whose sides the corners lie? An
// edge in the plane of `t` is left to its neighbours.
bool edge_meets(const CornerTriangle& from, std::size_t i, std::size_t j, const Signs& signs,
                const CornerTriangle& t) {
  if (signs[i] * signs[j] > 0 || (signs[i] == 0 && signs[j] == 0)) return false;
  return line_meets(from.at[i], from.at[j], t);
}

bool some_edge_meets(const CornerTriangle& from, const Signs& signs, const CornerTriangle& t) {
  return edge_meets(from, 0, 1, signs, t) || edge_meets(from, 1, 2, signs, t) ||
         edge_meets(from, 2, 0, signs, t);
}

// In one plane, seen along t.axis: has a side of `t` all these points strictly beyond it?
template <std::size_t Count>
bool is_beyond_a_side(const std::array<const Vec3d*, Count>& points, const CornerTriangle& t) {
  const int inward = orientation_along(t.axis, t.at[0], t.at[1], t.at[2]);
  for (std::size_t k = 0; k < 3; ++k) {
    bool beyond = true;
    for (std::size_t p = 0; p < Count && beyond; ++p) {
      beyond = orientation_along(t.axis, t.at[k], t.at[next(k)], *points[p]) == -inward;
    }
    if (beyond) return true;
  }
  return false;
}

bool overlap_in_plane(const CornerTriangle& a, const CornerTriangle& b) {
  return !is_beyond_a_side<3>({&b.at[0], &b.at[1], &b.at[2]}, a) &&
         !is_beyond_a_side<3>({&a.at[0], &a.at[1], &a.at[2]}, b);
}

// Two convex shapes in a plane are apart if and only if a side of one of them separates them.
bool segment_meets_in_plane(const Vec3d& p, const Vec3d& q, const CornerTriangle& t) {
  if (is_beyond_a_side<2>({&p, &q}, t)) return false;
  const int first = orientation_along(t.axis, p, q, t.at[0]);
  return first == 0 || orientation_along(t.axis, p, q, t.at[1]) != first ||
         orientation_along(t.axis, p, q, t.at[2]) != first;
}

bool opposite_side_meets_in_plane(const CornerTriangle& a, std::size_t corner,
                                  const CornerTriangle& b) {
  return segment_meets_in_plane(a.at[next(corner)], a.at[next(next(corner))], b);
}

// Seen along the axis of `t`: has a side of it all of `other` strictly beyond it, but for the
// corner that they share, at `i` and `j`, 3 for none? Then the two are apart, whatever their
// planes.
bool is_seen_beyond_a_side(const CornerTriangle& t, std::size_t i, const CornerTriangle& other,
                           std::size_t j) {
  const int inward = orientation_along(t.axis, t.at[0], t.at[1], t.at[2]);
  for (std::size_t k = 0; k < 3; ++k) {
    if (i < 3 && k == next(i)) continue;  // the shared corner is not beyond the side opposite to it
    bool beyond = true;
    for (std::size_t p = 0; p < 3 && beyond; ++p) {
      beyond = p == j || orientation_along(t.axis, t.at[k], t.at[next(k)], other.at[p]) == -inward;
    }
    if (beyond) return true;
  }
  return false;
}

// With at most one shared corner, at `i` of a and `j` of b, 3 for none.
Meeting meeting_across(const CornerTriangle& a, std::size_t i, const CornerTriangle& b,
                       std::size_t j) {
  Signs of_b = filtered_sides(a, b, j);
  if (is_one_sided(of_b, j)) return Meeting::apart;
  Signs of_a = filtered_sides(b, a, i);
  if (is_one_sided(of_a, i)) return Meeting::apart;
  if (is_seen_beyond_a_side(a, i, b, j) || is_seen_beyond_a_side(b, j, a, i)) {
    return Meeting::apart;
  }
  complete_sides(of_b, a, b, j);
  if (is_one_sided(of_b, j)) return Meeting::apart;
  const bool one_corner = i < 3;
  if (of_b == Signs{}) {
    const bool meet =
        one_corner ? opposite_side_meets_in_plane(a, i, b) || opposite_side_meets_in_plane(b, j, a)
                   : overlap_in_plane(a, b);
    return meet ? Meeting::coplanar : Meeting::apart;
  }
  complete_sides(of_a, b, a, i);
  if (is_one_sided(of_a, i)) return Meeting::apart;
  const bool meet = one_corner ? edge_meets(a, next(i), next(next(i)), of_a, b) ||
                                     edge_meets(b, next(j), next(next(j)), of_b, a)
                               : some_edge_meets(a, of_a, b) || some_edge_meets(b, of_b, a);
  if (!meet) return Meeting::apart;
  return is_on_both_sides(of_a) && is_on_both_sides(of_b) ? Meeting::crossing : Meeting::touching;
}

Meeting meeting_at_edge(const CornerTriangle& a, const CornerTriangle& b,
                        const SharedCorners& shared) {
  const Vec3d& p = a.at[shared.in_a[0]];
  const Vec3d& q = a.at[shared.in_a[1]];
  const Vec3d& tip_a = a.at[3 - shared.in_a[0] - shared.in_a[1]];
  const Vec3d& tip_b = b.at[3 - shared.in_b[0] - shared.in_b[1]];
  // Cheap first: seen along the axis the tips mostly lie on different sides of the edge.
  if (orientation_along(a.axis, p, q, tip_a) != orientation_along(a.axis, p, q, tip_b)) {
    return Meeting::apart;
  }
  return orientation(p, q, tip_a, tip_b) == 0 ? Meeting::coplanar : Meeting::apart;
}

bool is_near_plane(const CornerTriangle& a, const CornerTriangle& b, double distance) {
  const Vec3d first = b.at[1] - b.at[0], second = b.at[2] - b.at[0];
  const double unit = std::max(first.cwiseAbs().maxCoeff(), second.cwiseAbs().maxCoeff());
  const Vec3d normal = (first / unit).cross(second / unit);
  const double most = distance * normal.norm();
  return std::all_of(a.at.begin(), a.at.end(),
                     [&](const Vec3d& p) { return std::abs(normal.dot(p - b.at[0])) <= most; });
}

// Seen along the axis: has a side of b all of a on or beyond it?
bool is_outside_a_side(const CornerTriangle& a, const CornerTriangle& b, int axis) {
  const int inward = orientation_along(axis, b.at[0], b.at[1], b.at[2]);
  for (std::size_t k = 0; k < 3; ++k) {
    const bool outside = std::all_of(a.at.begin(), a.at.end(), [&](const Vec3d& p) {
      return orientation_along(axis, b.at[k], b.at[next(k)], p) != inward;
    });
    if (outside) return true;
  }
  return false;
}

}  // namespace

Meeting meeting_of(const CornerTriangle& a, const CornerTriangle& b) {
  const SharedCorners shared = shared_corners(a, b);
  if (shared.count == 0) return meeting_across(a, 3, b, 3);
  if (shared.count == 1) return meeting_across(a, shared.in_a[0], b, shared.in_b[0]);
  if (shared.count == 2) return meeting_at_edge(a, b, shared);
  return Meeting::coplanar;
}

bool nearly_overlap(const CornerTriangle& a, const CornerTriangle& b, double distance) {
  for (const int axis : {a.axis, b.axis}) {
    if (is_outside_a_side(a, b, axis) || is_outside_a_side(b, a, axis)) return false;
  }
  return is_near_plane(a, b, distance) || is_near_plane(b, a, distance);
}

}  // namespace meshrepair::internal
