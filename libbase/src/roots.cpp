// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

#include <base/roots.h>

namespace meshrepair {

namespace {

// Squares of lengths from kTiny to kHuge, times some powers of two, are normal numbers; kScale
// moves others there.
constexpr double kHuge = 0x1p511;
constexpr double kTiny = 0x1p-459;
constexpr double kScale = 0x1p600;

// A side shorter by this factor does not change the rounded length.
constexpr double kNegligible = 0x1p-54;

// C. F. Borges, An Improved Algorithm for hypot(a,b), 2019, algorithm "corrected unfused": the
// rounded root less its error, which is half of h^2 - long^2 - short^2 by h. Differences of near
// numbers are exact, so the terms of that are summed from these.
double corrected_length(double longer, double shorter) {
  const double h = std::sqrt(longer * longer + shorter * shorter);
  double error = 0;
  if (h <= 2 * shorter) {
    const double rest = h - shorter;
    error = longer * (2 * rest - longer) + (rest - 2 * (longer - shorter)) * rest;
  } else {
    const double rest = h - longer;
    error = 2 * rest * (longer - 2 * shorter) + ((4 * rest - shorter) * shorter + rest * rest);
  }
  return h - error / (2 * h);
}

}  // namespace

double hypotenuse(double x, double y) {
  if (std::isinf(x) || std::isinf(y)) return std::numeric_limits<double>::infinity();
  if (std::isnan(x) || std::isnan(y)) return std::numeric_limits<double>::quiet_NaN();
  double longer = std::abs(x);
  double shorter = std::abs(y);
  if (longer < shorter) std::swap(longer, shorter);
  if (longer >= shorter / kNegligible) return longer + shorter;
  if (longer > kHuge) return corrected_length(longer / kScale, shorter / kScale) * kScale;
  if (shorter < kTiny) return corrected_length(longer * kScale, shorter * kScale) / kScale;
  return corrected_length(longer, shorter);
}

double stable_length(const Vec3d& vector) {
  const double most = vector.cwiseAbs().maxCoeff();
  // Zero, infinite, or not a number.
  if (!(most > 0 && std::isfinite(most))) return vector.cwiseAbs().sum();
  return most * (vector / most).norm();
}

// Newton's method on a number from 1/2 to 4, from the secant of the root there. That is off by a
// ninth at most, and each step squares this share: the last two of six steps round alone.
double cube_root(double x) {
  if (x == 0 || !std::isfinite(x)) return x;
  constexpr int kSteps = 6;
  int exponent = 0;
  const double fraction = std::frexp(std::abs(x), &exponent);
  const int third = static_cast<int>(std::floor(exponent / 3.0));
  const double number = std::ldexp(fraction, exponent - 3 * third);
  double root = 0.68 + 0.2267 * number;
  for (int step = 0; step < kSteps; ++step) root -= (root - number / (root * root)) / 3;
  return std::copysign(std::ldexp(root, third), x);
}

// 10^22 is the last that is a double.
double power_of_ten(int exponent) {
  double power = 1;
  for (int i = 0; i < std::abs(exponent); ++i) power *= 10;
  return exponent < 0 ? 1 / power : power;
}

// The logarithm may be on either side of a whole number that it is near.
int decimal_exponent(double x) {
  const int near = static_cast<int>(std::floor(std::log10(x)));
  if (power_of_ten(near) > x) return near - 1;
  return power_of_ten(near + 1) <= x ? near + 1 : near;
}

}  // namespace meshrepair
