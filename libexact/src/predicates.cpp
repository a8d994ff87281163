// SPDX-License-Identifier: MIT
// Points as intersections of planes, and the side of a point.
//
// Sizes: coordinates differ by at most 2^26, so a normal's component is below 2^53 + 2^53 = 2^54
// and an offset below 3 * 2^54 * 2^25 < 2^81. With three such planes,
//   a component of n1 x n2     < 2 * 2^108          = 2^109   (128 bits),
//   denominator n3 . (n1 x n2) < 3 * 2^54 * 2^109   < 2^165   (256 bits),
//   numerator                  < 3 * 2^81 * 2^109   < 2^192   (256 bits),
//   side                       < 3 * 2^54 * 2^192 + 2^81 * 2^165 < 2^249   (256 bits).
// Nothing overflows, so no sign is ever a guess.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <base/roots.h>
#include <exact/predicates.h>

#include "predicates_internal.h"

namespace meshrepair {
namespace internal {
namespace {

using Normal = std::array<std::int64_t, 3>;
using Minor = std::array<Int128, 3>;

Minor cross(const Normal& a, const Normal& b) {
  return {Int128{a[1]} * b[2] - Int128{a[2]} * b[1], Int128{a[2]} * b[0] - Int128{a[0]} * b[2],
          Int128{a[0]} * b[1] - Int128{a[1]} * b[0]};
}

}  // namespace

Homogeneous meet_exactly(const Plane& a, const Plane& b, const Plane& c) {
  const Minor bc = cross(b.normal, c.normal);
  const Minor ca = cross(c.normal, a.normal);
  const Minor ab = cross(a.normal, b.normal);
  Homogeneous point;
  point.denominator = Int256::product(a.normal[0], bc[0]) + Int256::product(a.normal[1], bc[1]) +
                      Int256::product(a.normal[2], bc[2]);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    point.numerator[axis] =
        -(Int256::product(a.offset, bc[axis]) + Int256::product(b.offset, ca[axis]) +
          Int256::product(c.offset, ab[axis]));
  }
  return point;
}

int side_exactly(const Homogeneous& point, const Plane& plane) {
  // offset * denominator: the offset does not fit in 64 bits, so split it at 2^60.
  constexpr std::int64_t kSplit = std::int64_t{1} << 60;
  const auto high = static_cast<std::int64_t>(plane.offset / kSplit);
  const auto low = static_cast<std::int64_t>(plane.offset % kSplit);
  const Int256 value = point.numerator[0].times(plane.normal[0]) +
                       point.numerator[1].times(plane.normal[1]) +
                       point.numerator[2].times(plane.normal[2]) +
                       point.denominator.times(kSplit).times(high) + point.denominator.times(low);
  return value.sign() * point.denominator.sign();
}

// With e = 2^-53: components of unit normals carry 2e beyond a common scale (which moves no point),
// so a component of a cross product is off by at most 2 (4e + e) + e = 11e, the determinant by 3
// (11 + 2 + 1)e
// + 3e < 50e, a numerator (offsets below 2^26, carrying 3e) by 2^26 * 3 (11 + 3 + 2)e + ... < 2^26
// * 60e. Divided, with |position| < 2^26: (60 + 50 + 1) 2^26 e / |det| < 2^-20 / |det|.
Approximation meet_approximately(const Plane& a, const Plane& b, const Plane& c) {
  const auto& u = a.unit;
  const auto& v = b.unit;
  const auto& w = c.unit;
  const std::array<double, 3> vw = {v[1] * w[2] - v[2] * w[1], v[2] * w[0] - v[0] * w[2],
                                    v[0] * w[1] - v[1] * w[0]};
  const std::array<double, 3> wu = {w[1] * u[2] - w[2] * u[1], w[2] * u[0] - w[0] * u[2],
                                    w[0] * u[1] - w[1] * u[0]};
  const std::array<double, 3> uv = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                                    u[0] * v[1] - u[1] * v[0]};
  const double det = u[0] * vw[0] + u[1] * vw[1] + u[2] * vw[2];
  // Below this the determinant's own error (50e < 2^-47) is no longer small beside it.
  if (std::abs(det) < 0x1p-40) return {{}, std::numeric_limits<double>::infinity()};
  const double scale = -1 / det;
  Approximation result{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result.position[axis] =
        scale * (a.unit_offset * vw[axis] + b.unit_offset * wu[axis] + c.unit_offset * uv[axis]);
  }
  result.error = 0x1p-20 / std::abs(det);
  return result;
}

}  // namespace internal

namespace {

using internal::Homogeneous;

// Approximations worse than this many grid steps are computed again from the exact point.
constexpr double kLargestFilterError = 0x1p-6;
// Two correctly rounded conversions and a division: below 4 * 2^-53 of 2^26.
constexpr double kExactRounding = 0x1p-25;
// Every point of a complex lies in its box, well within this.
constexpr double kReach = 0x1p26;

bool within_reach(const std::array<double, 3>& p) {
  return std::abs(p[0]) < kReach && std::abs(p[1]) < kReach && std::abs(p[2]) < kReach;
}

// The lattice point that the approximation allows, if the three planes do meet there.
bool snap_to_lattice(const std::array<double, 3>& position, double error, const Plane& a,
                     const Plane& b, const Plane& c, GridPoint& found) {
  std::array<std::int32_t, 3> rounded{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double nearest = std::nearbyint(position[axis]);
    if (std::abs(position[axis] - nearest) > error) return false;
    rounded[axis] = static_cast<std::int32_t>(nearest);
  }
  found = {rounded[0], rounded[1], rounded[2]};
  return side(found, a) == 0 && side(found, b) == 0 && side(found, c) == 0;
}

std::array<double, 3> rounded(const Homogeneous& point) {
  const double denominator = point.denominator.to_double();
  return {point.numerator[0].to_double() / denominator,
          point.numerator[1].to_double() / denominator,
          point.numerator[2].to_double() / denominator};
}

Point make_point(const std::array<double, 3>& position, double error,
                 const std::array<PlaneId, 3>& ids, const PlaneTable& planes) {
  GridPoint found;
  if (snap_to_lattice(position, error, planes[ids[0]], planes[ids[1]], planes[ids[2]], found)) {
    return lattice_point(found);
  }
  return {position, static_cast<float>(error * 1.0000002), ids};
}

}  // namespace

Point lattice_point(const GridPoint& at) {
  return {{static_cast<double>(at.x), static_cast<double>(at.y), static_cast<double>(at.z)}, 0, {}};
}

Point loose_point(const std::array<double, 3>& at, double tolerance) {
  return {at, std::max(static_cast<float>(tolerance), std::numeric_limits<float>::min()), {}};
}

Point meet(const PlaneTable& planes, PlaneId a, PlaneId b, PlaneId c,
           const std::array<double, 3>& fallback) {
  // Sorted, so that the approximation does not depend on the order either.
  if (b < a) std::swap(a, b);
  if (c < b) std::swap(b, c);
  if (b < a) std::swap(a, b);
  const std::array<PlaneId, 3> ids = {a, b, c};
  const auto fast = internal::meet_approximately(planes[a], planes[b], planes[c]);
  if (fast.error <= kLargestFilterError) {
    if (!within_reach(fast.position)) return loose_point(fallback);
    return make_point(fast.position, fast.error, ids, planes);
  }
  const Homogeneous exact = internal::meet_exactly(planes[a], planes[b], planes[c]);
  if (exact.denominator.sign() == 0) return loose_point(fallback);
  const std::array<double, 3> position = rounded(exact);
  if (!within_reach(position)) return loose_point(fallback);
  return make_point(position, kExactRounding, ids, planes);
}

std::array<double, 3> accurate_position(const Point& point, const PlaneTable& planes) {
  if (!point.planes[0].valid()) return point.position;
  return rounded(internal::meet_exactly(planes[point.planes[0]], planes[point.planes[1]],
                                        planes[point.planes[2]]));
}

namespace {

int side_of_meet(const Point& point, const Plane& plane, const PlaneTable& planes) {
  const Homogeneous exact = internal::meet_exactly(planes[point.planes[0]], planes[point.planes[1]],
                                                   planes[point.planes[2]]);
  return internal::side_exactly(exact, plane);
}

int side_of_loose_point(const Point& point, const Plane& plane) {
  const double distance = signed_distance(point.position, plane);
  const auto tolerance = static_cast<double>(point.error);
  return (distance > tolerance) - (distance < -tolerance);
}

}  // namespace

int side_without_filter(const Point& point, PlaneId plane_id, const PlaneTable& planes) {
  if (point.is_lattice()) return side(point.lattice(), planes[plane_id]);
  if (point.is_loose()) return side_of_loose_point(point, planes[plane_id]);
  if (std::find(point.planes.begin(), point.planes.end(), plane_id) != point.planes.end()) return 0;
  return side_of_meet(point, planes[plane_id], planes);
}

int side(const Point& point, const Plane& plane, const PlaneTable& planes) {
  const double distance = signed_distance(point.position, plane);
  const double bound = kDistanceError + 1.7321 * static_cast<double>(point.error);
  if (distance > bound) return 1;
  if (distance < -bound) return -1;
  if (point.is_lattice()) return side(point.lattice(), plane);
  if (point.is_loose()) return side_of_loose_point(point, plane);
  return side_of_meet(point, plane, planes);
}

// The turn of three points, projected along the dominant axis of their plane.
//
// Sizes: a numerator is below 2^192 and a denominator below 2^165 (see predicates.cpp), so each of
// the six products of the determinant is below 2^(192 + 192 + 165) and their sum fits in 768 bits.

namespace {

using Int768 = WideInt<12>;

struct Projection {
  std::size_t x = 0, y = 1;
  int sign = 1;  // of the normal along the axis left out
};

Projection projection_along(const Plane& plane) {
  const auto axis = static_cast<std::size_t>(dominant_axis(plane));
  return {(axis + 1) % 3, (axis + 2) % 3, plane.normal[axis] < 0 ? -1 : 1};
}

// With e = 2^-53 and d the sum of two points' errors: the coordinates' differences are off by d and
// e of themselves, the products by e, the last difference by e of the result.
int turn_by_doubles(const Point& a, const Point& b, const Point& c, const Projection& to,
                    double& area) {
  const double bx = b.position[to.x] - a.position[to.x];
  const double by = b.position[to.y] - a.position[to.y];
  const double cx = c.position[to.x] - a.position[to.x];
  const double cy = c.position[to.y] - a.position[to.y];
  area = bx * cy - by * cx;
  const double d = 2 * static_cast<double>(std::max({a.error, b.error, c.error}));
  const double bound =
      (std::abs(bx * cy) + std::abs(by * cx)) * 0x1p-50 +
      1.001 * d * (std::abs(bx) + std::abs(by) + std::abs(cx) + std::abs(cy) + 2 * d);
  return (area > bound) - (area < -bound);
}

// In a line when one of them is within the tolerance of the line through the two others.
int turn_of_loose_points(const Point& a, const Point& b, const Point& c, const Projection& to,
                         double area) {
  const auto distance = [&](const Point& p, const Point& q) {
    return hypotenuse(p.position[to.x] - q.position[to.x], p.position[to.y] - q.position[to.y]);
  };
  const auto tolerance = static_cast<double>(std::max({a.error, b.error, c.error}));
  const double least = tolerance * std::max({distance(a, b), distance(b, c), distance(c, a)});
  return (area > least) - (area < -least);
}

int turn_on_lattice(const GridPoint& a, const GridPoint& b, const GridPoint& c,
                    const Projection& to) {
  const auto difference = [](const GridPoint& p, const GridPoint& q, std::size_t axis) {
    const std::array<std::int64_t, 3> d = {std::int64_t{p.x} - q.x, std::int64_t{p.y} - q.y,
                                           std::int64_t{p.z} - q.z};
    return d[axis];
  };
  const std::int64_t area = difference(b, a, to.x) * difference(c, a, to.y) -
                            difference(b, a, to.y) * difference(c, a, to.x);
  return (area > 0) - (area < 0);
}

// A point whose three planes include `plane` lies on two more; three points of the plane that share
// another plane lie in its line.
bool share_a_line(const Point& a, const Point& b, const Point& c, PlaneId plane) {
  const auto has = [](const Point& p, PlaneId id) {
    return std::find(p.planes.begin(), p.planes.end(), id) != p.planes.end();
  };
  return std::any_of(a.planes.begin(), a.planes.end(), [&](PlaneId id) {
    return id.valid() && id != plane && has(b, id) && has(c, id);
  });
}

internal::Homogeneous homogeneous(const Point& p, const PlaneTable& planes) {
  if (!p.is_lattice()) {
    return internal::meet_exactly(planes[p.planes[0]], planes[p.planes[1]], planes[p.planes[2]]);
  }
  const GridPoint at = p.lattice();
  return {{Int256(at.x), Int256(at.y), Int256(at.z)}, Int256(1)};
}

int turn_exactly(const internal::Homogeneous& a, const internal::Homogeneous& b,
                 const internal::Homogeneous& c, const Projection& to) {
  const auto minor = [&](const internal::Homogeneous& p, const internal::Homogeneous& q) {
    return p.numerator[to.x] * q.numerator[to.y] - p.numerator[to.y] * q.numerator[to.x];
  };
  const Int768 area =
      minor(b, c) * a.denominator + minor(c, a) * b.denominator + minor(a, b) * c.denominator;
  return area.sign() * a.denominator.sign() * b.denominator.sign() * c.denominator.sign();
}

}  // namespace

int turn(const Point& a, const Point& b, const Point& c, PlaneId plane, const PlaneTable& planes) {
  const Projection to = projection_along(planes[plane]);
  double area = 0;
  const int filtered = turn_by_doubles(a, b, c, to, area);
  if (filtered != 0) return to.sign * filtered;
  if (a.is_lattice() && b.is_lattice() && c.is_lattice()) {
    return to.sign * turn_on_lattice(a.lattice(), b.lattice(), c.lattice(), to);
  }
  if (a.is_loose() || b.is_loose() || c.is_loose()) {
    return to.sign * turn_of_loose_points(a, b, c, to, area);
  }
  if (share_a_line(a, b, c, plane)) return 0;
  return to.sign *
         turn_exactly(homogeneous(a, planes), homogeneous(b, planes), homogeneous(c, planes), to);
}

}  // namespace meshrepair
