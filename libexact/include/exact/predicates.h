// SPDX-License-Identifier: MIT
// The exact predicates: on which side of a plane does a point lie, and which way do three points of
// it turn?
//
// Properties: side(p, P) is the sign of normal(P) . p + offset(P), without error, for lattice
// points and points given by three planes. side(meet(A, B, C), A) == 0. Turning a plane round turns
// the sign. The answer does not depend on which three planes stand for a point, nor on the
// approximation stored in it. Loose points get the sign of their rounded distance, or 0 within
// their tolerance.
#pragma once

#include <cmath>

#include <exact/plane_table.h>
#include <exact/point.h>

namespace meshrepair {

// Bound on the rounding error of signed_distance() for a point with exact coordinates inside the
// working box (|coordinate| < 2^25.2, so |x| < 2^26, and |offset| < 2^26 for every plane that meets
// the box). With e = 2^-53, each unit normal component carries 2e beyond the common scale, its
// product e, the offset 3e, the three additions e each on sums below 2^27: (3 + 3 + 6) 2^26 e <
// 2^-23.
inline constexpr double kDistanceError = 0x1p-23;

// Distance to the plane in grid units, positive on its positive side, rounded.
[[nodiscard]] inline double signed_distance(const std::array<double, 3>& position,
                                            const Plane& plane) {
  return plane.unit[0] * position[0] + plane.unit[1] * position[1] + plane.unit[2] * position[2] +
         plane.unit_offset;
}

// The later stages of the ladder; called where the rounded distance decides nothing.
[[nodiscard]] int side_without_filter(const Point& point, PlaneId plane_id,
                                      const PlaneTable& planes);

// -1, 0 or +1.
[[nodiscard]] inline int side(const Point& point, PlaneId plane_id, const PlaneTable& planes) {
  const double distance = signed_distance(point.position, planes[plane_id]);
  // The coordinates' errors add up to at most |n|_1 error <= sqrt(3) error.
  const double bound = kDistanceError + 1.7321 * static_cast<double>(point.error);
  if (distance > bound) return 1;
  if (distance < -bound) return -1;
  return side_without_filter(point, plane_id, planes);
}

// The same for planes that are in no table.
[[nodiscard]] int side(const Point& point, const Plane& plane, const PlaneTable& planes);

// Sign of normal . p + offset for a grid point, in 128 bits.
[[nodiscard]] inline int side(const GridPoint& p, const Plane& plane) {
  return sign_of(Int128{plane.normal[0]} * p.x + Int128{plane.normal[1]} * p.y +
                 Int128{plane.normal[2]} * p.z + plane.offset);
}

// +1 counter-clockwise, -1 clockwise, 0 in a line. All three lie in `plane`.
//
// Properties: it is the sign of the triangle's area seen from where the plane's normal points,
// without error, for lattice points and points given by three planes. It stays when the points are
// rotated and changes sign when two of them change places. Loose points get the sign of their
// rounded area, or 0 where one is within its tolerance of the line through the others.
[[nodiscard]] int turn(const Point& a, const Point& b, const Point& c, PlaneId plane,
                       const PlaneTable& planes);

}  // namespace meshrepair
