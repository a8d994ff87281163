// SPDX-License-Identifier: MIT
#include <numeric>

#include <exact/plane.h>

namespace meshrepair {

Plane make_plane(const std::array<std::int64_t, 3>& normal, Int128 offset) {
  Plane plane{normal, offset, {}, 0};
  const double x = static_cast<double>(normal[0]);
  const double y = static_cast<double>(normal[1]);
  const double z = static_cast<double>(normal[2]);
  const double length = std::sqrt(x * x + y * y + z * z);
  if (length > 0) {
    plane.unit = {x / length, y / length, z / length};
    plane.unit_offset = static_cast<double>(offset) / length;
  }
  return plane;
}

Plane plane_through(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  const std::int64_t ux = std::int64_t{b.x} - a.x, uy = std::int64_t{b.y} - a.y,
                     uz = std::int64_t{b.z} - a.z;
  const std::int64_t vx = std::int64_t{c.x} - a.x, vy = std::int64_t{c.y} - a.y,
                     vz = std::int64_t{c.z} - a.z;
  const std::array<std::int64_t, 3> n = {uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx};
  return make_plane(n, -(Int128{n[0]} * a.x + Int128{n[1]} * a.y + Int128{n[2]} * a.z));
}

Plane plane_along_axis(const GridPoint& a, const GridPoint& b, int axis) {
  const std::int64_t ux = std::int64_t{b.x} - a.x, uy = std::int64_t{b.y} - a.y,
                     uz = std::int64_t{b.z} - a.z;
  std::array<std::int64_t, 3> n{};
  switch (axis) {
    case 0:
      n = {0, uz, -uy};
      break;
    case 1:
      n = {-uz, 0, ux};
      break;
    default:
      n = {uy, -ux, 0};
      break;
  }
  return make_plane(n, -(Int128{n[0]} * a.x + Int128{n[1]} * a.y + Int128{n[2]} * a.z));
}

int dominant_axis(const Plane& plane) {
  std::size_t best = 0;
  for (std::size_t axis = 1; axis < 3; ++axis) {
    if (std::abs(plane.normal[axis]) > std::abs(plane.normal[best])) best = axis;
  }
  return static_cast<int>(best);
}

bool make_canonical(Plane& plane) {
  auto& n = plane.normal;
  std::int64_t divisor = std::gcd(std::gcd(n[0], n[1]), n[2]);
  // A plane through a grid point has an offset that its normal's divisor divides; others may not.
  if (divisor > 1 && plane.offset % divisor != 0) {
    divisor = std::gcd(divisor, static_cast<std::int64_t>(plane.offset % divisor));
  }
  const bool turned = n[0] < 0 || (n[0] == 0 && (n[1] < 0 || (n[1] == 0 && n[2] < 0)));
  const std::int64_t by = turned ? -divisor : divisor;
  if (by != 1 && by != 0) {
    plane = make_plane({n[0] / by, n[1] / by, n[2] / by}, plane.offset / by);
  }
  return turned;
}

bool comes_before(Plane a, Plane b) {
  make_canonical(a);
  make_canonical(b);
  return a.normal != b.normal ? a.normal < b.normal : a.offset < b.offset;
}

}  // namespace meshrepair
