// SPDX-License-Identifier: MIT
// Each predicate is a ladder: the filter in doubles (in the header, to be inlined), then
// fixed-width integers where the differences of the coordinates allow them, which they nearly
// always do, for orientation() a filter in numbers of two doubles, and last integers as long as it
// takes. The integers are the coordinates times a power
// of two, so nothing is lost on the way and no sign is a matter of rounding.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <exact/double_predicates.h>
#include <exact/wide_int.h>

#include "big_integer.h"
#include "double_predicates_internal.h"

namespace meshrepair {
namespace internal {
namespace {

// Between these the scale below and what it is multiplied with are normal numbers.
constexpr double kSmallestScaled = 0x1p-900;
constexpr double kLargestScaled = 0x1p900;
// Scaled differences stay below 2^61, minors below 2^123, determinants below 2^186.
constexpr int kShortBits = 61;
// Numbers of two doubles: six operations for each part of the sum, each off by less than 2^-103.
constexpr double kLongError = 0x1p-100;
constexpr double kLongUnderflow = 0x1p-1040;

// x - y is `difference` without error: the rounding error of a subtraction, by Knuth's formula.
bool is_exact_difference(double x, double y, double difference) {
  const double virtual_y = x - difference;
  const double virtual_x = difference + virtual_y;
  return (x - virtual_x) + (virtual_y - y) == 0;
}

// Points 1 to Count - 1 minus point 0, as integers of a common unit. False where they are too long.
template <std::size_t Count, std::size_t Axes>
bool short_differences(const std::array<const Vec3d*, Count>& points,
                       const std::array<int, Axes>& axes,
                       std::array<std::array<std::int64_t, Axes>, Count - 1>& integers) {
  std::array<std::array<double, Axes>, Count - 1> differences;
  double largest = 0;
  for (std::size_t p = 1; p < Count; ++p) {
    for (std::size_t k = 0; k < Axes; ++k) {
      const double x = (*points[p])[axes[k]], y = (*points[0])[axes[k]];
      const double difference = x - y;
      if (!is_exact_difference(x, y, difference)) return false;
      differences[p - 1][k] = difference;
      largest = std::max(largest, std::abs(difference));
    }
  }
  if (!(largest > kSmallestScaled && largest < kLargestScaled)) return false;
  const double scale = std::ldexp(1.0, kShortBits - 1 - std::ilogb(largest));
  for (std::size_t p = 0; p + 1 < Count; ++p) {
    for (std::size_t k = 0; k < Axes; ++k) {
      const double scaled = differences[p][k] * scale;
      integers[p][k] = static_cast<std::int64_t>(scaled);
      const bool underflowed = scaled == 0 && differences[p][k] != 0;
      if (underflowed || static_cast<double>(integers[p][k]) != scaled) return false;
    }
  }
  return true;
}

// The same in integers of any length.
template <std::size_t Count, std::size_t Axes>
std::array<std::array<BigInteger, Axes>, Count - 1> long_differences(
    const std::array<const Vec3d*, Count>& points, const std::array<int, Axes>& axes) {
  int unit = 1024;
  for (const Vec3d* point : points) {
    for (const int axis : axes) {
      if ((*point)[axis] != 0) unit = std::min(unit, unit_exponent((*point)[axis]));
    }
  }
  std::array<std::array<BigInteger, Axes>, Count - 1> differences;
  for (std::size_t p = 1; p < Count; ++p) {
    for (std::size_t k = 0; k < Axes; ++k) {
      differences[p - 1][k] =
          BigInteger((*points[p])[axes[k]], unit) - BigInteger((*points[0])[axes[k]], unit);
    }
  }
  return differences;
}

// hi + lo, where lo is what rounding left of hi: about 106 bits.
struct LongDouble {
  double hi = 0, lo = 0;
};

// Without error (Knuth), and with one below 2^-103 of the result (Dekker) where nothing underflows.
LongDouble exact_sum(double x, double y) {
  const double sum = x + y, part = sum - x;
  return {sum, (x - (sum - part)) + (y - part)};
}

// The number as a sum of two that have half the bits each, so that products of such are exact
// (Veltkamp).
LongDouble halves(double x) {
  constexpr double kSplit = 0x1p27 + 1;
  const double large = kSplit * x, hi = large - (large - x);
  return {hi, x - hi};
}

// What rounding left of it, exactly (Dekker). That is what std::fma() is for, but the one of a C
// library may round more than once, as that of mingw-w64 does.
double rest_of_product(double x, double y, double product) {
  const LongDouble a = halves(x), b = halves(y);
  return a.lo * b.lo - (((product - a.hi * b.hi) - a.lo * b.hi) - a.hi * b.lo);
}

LongDouble operator*(const LongDouble& x, const LongDouble& y) {
  const double product = x.hi * y.hi;
  return exact_sum(product, rest_of_product(x.hi, y.hi, product) + (x.hi * y.lo + x.lo * y.hi));
}

// Off by less than 2^-103 of |x| + |y|.
LongDouble operator+(const LongDouble& x, const LongDouble& y) {
  const LongDouble sum = exact_sum(x.hi, y.hi);
  return exact_sum(sum.hi, sum.lo + (x.lo + y.lo));
}

LongDouble operator-(const LongDouble& x, const LongDouble& y) {
  return x + LongDouble{-y.hi, -y.lo};
}

std::array<int, 2> other_axes(int axis) { return {(axis + 1) % 3, (axis + 2) % 3}; }

constexpr std::array<int, 3> kAllAxes = {0, 1, 2};

}  // namespace

std::optional<int> short_orientation(const Vec3d& a, const Vec3d& b, const Vec3d& c,
                                     const Vec3d& d) {
  std::array<std::array<std::int64_t, 3>, 3> rows{};
  if (!short_differences<4, 3>({&a, &b, &c, &d}, kAllAxes, rows)) return std::nullopt;
  const auto minor = [&](std::size_t i, std::size_t j) {
    return Int128{rows[1][i]} * rows[2][j] - Int128{rows[1][j]} * rows[2][i];
  };
  const Int256 determinant = Int256::product(minor(1, 2), Int128{rows[0][0]}) +
                             Int256::product(minor(2, 0), Int128{rows[0][1]}) +
                             Int256::product(minor(0, 1), Int128{rows[0][2]});
  return determinant.sign();
}

std::optional<int> short_orientation_along(int axis, const Vec3d& a, const Vec3d& b,
                                           const Vec3d& c) {
  std::array<std::array<std::int64_t, 2>, 2> rows{};
  if (!short_differences<3, 2>({&a, &b, &c}, other_axes(axis), rows)) return std::nullopt;
  return sign_of(Int128{rows[0][0]} * rows[1][1] - Int128{rows[0][1]} * rows[1][0]);
}

// The largest difference is scaled to between 1 and 2, so that underflow adds less than 2^-1060.
int filtered_long_orientation(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
  const std::array<const Vec3d*, 3> others{&b, &c, &d};
  std::array<std::array<LongDouble, 3>, 3> rows;
  double largest = 0;
  for (std::size_t p = 0; p < 3; ++p) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      rows[p][k] = exact_sum((*others[p])[axis], -a[axis]);
      largest = std::max(largest, std::abs(rows[p][k].hi));
    }
  }
  if (!(largest > kSmallestScaled && largest < kLargestScaled)) return 0;
  const double scale = std::ldexp(1.0, -std::ilogb(largest));
  for (auto& row : rows) {
    for (LongDouble& e : row) e = {e.hi * scale, e.lo * scale};
  }
  const auto& [x, y, z] = rows;
  LongDouble value;
  double size = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
    const LongDouble left = y[u] * z[v], right = y[v] * z[u];
    value = value + x[k] * (left - right);
    size += std::abs(x[k].hi) * (std::abs(left.hi) + std::abs(right.hi));
  }
  const double error = kLongError * size + kLongUnderflow;
  return static_cast<int>(value.hi > error) - static_cast<int>(value.hi < -error);
}

int long_orientation(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
  const auto rows = long_differences<4, 3>({&a, &b, &c, &d}, kAllAxes);
  const auto minor = [&](std::size_t i, std::size_t j) {
    return rows[1][i] * rows[2][j] - rows[1][j] * rows[2][i];
  };
  return (rows[0][0] * minor(1, 2) + rows[0][1] * minor(2, 0) + rows[0][2] * minor(0, 1)).sign();
}

int long_orientation_along(int axis, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const auto rows = long_differences<3, 2>({&a, &b, &c}, other_axes(axis));
  return (rows[0][0] * rows[1][1] - rows[0][1] * rows[1][0]).sign();
}

int exact_orientation(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
  // The commonest reason why a filter fails: a plane across an axis.
  for (const int axis : kAllAxes) {
    if (a[axis] == b[axis] && a[axis] == c[axis] && a[axis] == d[axis]) return 0;
  }
  if (const std::optional<int> sign = short_orientation(a, b, c, d)) return *sign;
  const int sign = filtered_long_orientation(a, b, c, d);
  return sign != 0 ? sign : long_orientation(a, b, c, d);
}

int exact_orientation_along(int axis, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const std::optional<int> sign = short_orientation_along(axis, a, b, c);
  return sign ? *sign : long_orientation_along(axis, a, b, c);
}

}  // namespace internal

int projection_axis(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const double bx = b[0] - a[0], by = b[1] - a[1], bz = b[2] - a[2];
  const double cx = c[0] - a[0], cy = c[1] - a[1], cz = c[2] - a[2];
  const std::array<double, 3> normal = {std::abs(by * cz - bz * cy), std::abs(bz * cx - bx * cz),
                                        std::abs(bx * cy - by * cx)};
  const int first =
      static_cast<int>(std::max_element(normal.begin(), normal.end()) - normal.begin());
  for (const int axis : {first, (first + 1) % 3, (first + 2) % 3}) {
    if (orientation_along(axis, a, b, c) != 0) return axis;
  }
  return -1;
}

}  // namespace meshrepair
