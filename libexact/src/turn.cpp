// The turn of three points, projected along the dominant axis of their plane.
//
// Sizes: a numerator is below 2^192 and a denominator below 2^165 (see predicates.cpp), so each of
// the six products of the determinant is below 2^(192 + 192 + 165) and their sum fits in 768 bits.
#include <algorithm>
#include <array>
#include <cmath>

#include <exact/predicates.h>
#include <exact/turn.h>

#include "predicates_internal.h"

namespace meshrepair {
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
    return std::hypot(p.position[to.x] - q.position[to.x], p.position[to.y] - q.position[to.y]);
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
