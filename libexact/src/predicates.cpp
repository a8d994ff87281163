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
#include <limits>
#include <utility>

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

}  // namespace meshrepair
