// SPDX-License-Identifier: MIT
// Exact orientation predicates on points whose coordinates are any finite doubles.
//
// Properties: swapping two points turns the sign; moving all points by the same exact offset, or
// scaling them by the same positive power of two, does not change it; 0 means exactly coplanar
// (collinear), whatever the magnitudes. No number is too large or too small.
#pragma once

#include <algorithm>
#include <cmath>

#include <base/vec3.h>

namespace meshrepair {

namespace internal {

[[nodiscard]] int exact_orientation(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d);
[[nodiscard]] int exact_orientation_along(int axis, const Vec3d& a, const Vec3d& b, const Vec3d& c);

// With e = 2^-53, a difference of coordinates is off by a factor (1 + e), a product of two of them
// by (1 + e)^3, a minor by (1 + e)^4 of the sum of its products' magnitudes, the determinant by
// (1 + e)^8 of the sum `size` of the magnitudes of its six products. `size` itself is computed to
// the same factor, so 9 e size covers it all. Underflow adds at most 2^-1073 to each minor, which a
// difference below kLargestDifference turns into less than kUnderflow; above it a product of three
// may overflow, too.
inline constexpr double kOrientationError = 9 * 0x1p-53;
inline constexpr double kOrientationAlongError = 5 * 0x1p-53;
inline constexpr double kLargestDifference = 0x1p300;
inline constexpr double kUnderflow = 0x1p-760;

// The part of a determinant (b - a, c - a, d - a) that is the same for every d.
class PlaneFilter {
 public:
  PlaneFilter(const Vec3d& a, const Vec3d& b, const Vec3d& c) : a_(a) {
    const double bx = b[0] - a[0], by = b[1] - a[1], bz = b[2] - a[2];
    const double cx = c[0] - a[0], cy = c[1] - a[1], cz = c[2] - a[2];
    const double yz = by * cz, zy = bz * cy, zx = bz * cx, xz = bx * cz, xy = bx * cy, yx = by * cx;
    minor_ = Vec3d(yz - zy, zx - xz, xy - yx);
    size_ = Vec3d(std::abs(yz) + std::abs(zy), std::abs(zx) + std::abs(xz),
                  std::abs(xy) + std::abs(yx));
    largest_ = std::max(
        {std::abs(bx), std::abs(by), std::abs(bz), std::abs(cx), std::abs(cy), std::abs(cz)});
  }

  // The sign if doubles can tell, 0 otherwise.
  [[nodiscard]] int side(const Vec3d& d) const {
    const double x = d[0] - a_[0], y = d[1] - a_[1], z = d[2] - a_[2];
    const double value = x * minor_[0] + y * minor_[1] + z * minor_[2];
    const double size = std::abs(x) * size_[0] + std::abs(y) * size_[1] + std::abs(z) * size_[2];
    const double largest = std::max({largest_, std::abs(x), std::abs(y), std::abs(z)});
    if (!(largest <= kLargestDifference)) return 0;
    const double error = kOrientationError * size + kUnderflow;
    return static_cast<int>(value > error) - static_cast<int>(value < -error);
  }

 private:
  Vec3d a_, minor_, size_;
  double largest_;
};

// The same of (b - a, c - a) in the plane of the two coordinates u and v.
[[nodiscard]] inline int filtered_orientation_along(int u, int v, const Vec3d& a, const Vec3d& b,
                                                    const Vec3d& c) {
  const double bu = b[u] - a[u], bv = b[v] - a[v], cu = c[u] - a[u], cv = c[v] - a[v];
  const double left = bu * cv, right = bv * cu;
  const double largest = std::max({std::abs(bu), std::abs(bv), std::abs(cu), std::abs(cv)});
  if (!(largest <= kLargestDifference)) return 0;
  const double value = left - right;
  const double error = kOrientationAlongError * (std::abs(left) + std::abs(right)) + kUnderflow;
  return static_cast<int>(value > error) - static_cast<int>(value < -error);
}

}  // namespace internal

// On which side of the plane through a, b and c is d? 1: on the one that (b - a) x (c - a) points
// to, from where a, b, c are counter-clockwise; -1: on the other; 0: in the plane, or a, b and c
// are collinear.
[[nodiscard]] inline int orientation(const Vec3d& a, const Vec3d& b, const Vec3d& c,
                                     const Vec3d& d) {
  const int sign = internal::PlaneFilter(a, b, c).side(d);
  return sign != 0 ? sign : internal::exact_orientation(a, b, c, d);
}

// The turn from a over b to c after dropping the coordinate `axis` (0, 1 or 2): the sign of that
// component of (b - a) x (c - a).
[[nodiscard]] inline int orientation_along(int axis, const Vec3d& a, const Vec3d& b,
                                           const Vec3d& c) {
  const int u = axis == 2 ? 0 : axis + 1;
  const int v = u == 2 ? 0 : u + 1;
  const int sign = internal::filtered_orientation_along(u, v, a, b, c);
  return sign != 0 ? sign : internal::exact_orientation_along(axis, a, b, c);
}

// An axis along which the triangle's projection has an area, the one with the largest if rounding
// allows to tell; -1 if a, b and c are collinear.
[[nodiscard]] int projection_axis(const Vec3d& a, const Vec3d& b, const Vec3d& c);

}  // namespace meshrepair
