// SPDX-License-Identifier: MIT
// Planes with integer coefficients over the working grid.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include <exact/grid.h>
#include <exact/wide_int.h>

namespace meshrepair {

// The points x with normal . x + offset = 0; the side is positive where the normal points. |normal|
// < 2^54 and |offset| < 2^81 by component (a cross product of differences of 26-bit coordinates,
// and its dot product with a grid point).
struct Plane {
  std::array<std::int64_t, 3> normal{};
  Int128 offset = 0;
  // The same plane scaled to a normal of length 1, rounded: for the filters alone.
  std::array<double, 3> unit{};
  double unit_offset = 0;
};

// The plane with these coefficients, which must not all be zero; fills in the rounded copy.
[[nodiscard]] Plane make_plane(const std::array<std::int64_t, 3>& normal, Int128 offset);

// The plane through three grid points, the normal pointing to where they are seen
// counter-clockwise. Its normal is zero when the points are collinear.
[[nodiscard]] Plane plane_through(const GridPoint& a, const GridPoint& b, const GridPoint& c);

// The plane that contains the line a b and the direction of a coordinate axis. The normal is zero
// when the line runs along that axis.
[[nodiscard]] Plane plane_along_axis(const GridPoint& a, const GridPoint& b, int axis);

// The axis on which the plane's normal has its largest component; the lowest of equal ones.
// Projecting along it maps the plane one to one.
[[nodiscard]] int dominant_axis(const Plane& plane);

// Same points, same side?
[[nodiscard]] inline bool same_coefficients(const Plane& a, const Plane& b) {
  return a.normal == b.normal && a.offset == b.offset;
}

[[nodiscard]] inline bool is_null(const Plane& plane) {
  return plane.normal[0] == 0 && plane.normal[1] == 0 && plane.normal[2] == 0;
}

// Divides by the greatest common divisor and makes the first component that is not zero positive,
// so that equal planes have equal coefficients. Returns whether the normal was turned round.
bool make_canonical(Plane& plane);

// A total order of planes that does not depend on how they are turned or scaled: for breaking ties
// in a way that the orientation of the input cannot change.
[[nodiscard]] bool comes_before(Plane a, Plane b);

}  // namespace meshrepair
