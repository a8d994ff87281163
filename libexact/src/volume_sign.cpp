// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <optional>

#include <exact/double_predicates.h>
#include <exact/volume_sign.h>

#include "big_integer.h"

namespace meshrepair {
namespace {

using internal::BigInteger;

using Points = std::span<const Vec3d>;
using Triangles = std::span<const std::array<std::uint32_t, 3>>;
using Which = std::span<const std::uint32_t>;

// Each determinant has the error of an orientation (double_predicates.h): 9 e times the magnitude
// of its products. Adding n of them adds n e times their sum, computing that sum as much again.
std::optional<int> filtered_sign(Points points, Triangles triangles, Which which) {
  const Vec3d& base = points[triangles[which[0]][0]];
  double sum = 0, size = 0, largest = 0;
  for (const std::uint32_t t : which) {
    const auto& corner = triangles[t];
    const Vec3d a = points[corner[0]] - base;
    const Vec3d b = points[corner[1]] - base;
    const Vec3d c = points[corner[2]] - base;
    for (const Vec3d* p : {&a, &b, &c}) largest = std::max(largest, p->cwiseAbs().maxCoeff());
    for (int k = 0; k < 3; ++k) {
      const double left = b[(k + 1) % 3] * c[(k + 2) % 3];
      const double right = b[(k + 2) % 3] * c[(k + 1) % 3];
      sum += a[k] * (left - right);
      size += std::abs(a[k]) * (std::abs(left) + std::abs(right));
    }
  }
  if (!(largest <= internal::kLargestDifference)) return std::nullopt;
  const auto terms = 3 * static_cast<double>(which.size());
  const double error =
      (internal::kOrientationError + 2 * terms * 0x1p-53) * size + terms * internal::kUnderflow;
  if (sum > error) return 1;
  if (sum < -error) return -1;
  return std::nullopt;
}

// About the origin, which is as good as any other place as the surface is closed.
int exact_sign(Points points, Triangles triangles, Which which) {
  int unit = 1024;
  for (const std::uint32_t t : which) {
    for (const std::uint32_t p : triangles[t]) {
      for (const double x : points[p]) {
        if (x != 0) unit = std::min(unit, internal::unit_exponent(x));
      }
    }
  }
  BigInteger sum;
  for (const std::uint32_t t : which) {
    const auto& corner = triangles[t];
    const auto x = [&](std::size_t k, int axis) {
      return BigInteger(points[corner[k]][axis % 3], unit);
    };
    for (int k = 0; k < 3; ++k) {
      sum = sum + x(0, k) * (x(1, k + 1) * x(2, k + 2) - x(1, k + 2) * x(2, k + 1));
    }
  }
  return sum.sign();
}

}  // namespace

int volume_sign(Points points, Triangles triangles, Which which) {
  if (which.empty()) return 0;
  const std::optional<int> sign = filtered_sign(points, triangles, which);
  return sign ? *sign : exact_sign(points, triangles, which);
}

}  // namespace meshrepair
