// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>

#include <base/angles.h>

namespace meshrepair {
namespace {

// The tangent of half the angle with this tangent.
double half_angle_tangent(double tangent) {
  return tangent / (1 + std::sqrt(1 + tangent * tangent));
}

// Of a tangent of at most 1. The power series of a quarter of the angle, whose tangent is below
// 0.2, ends where its terms round away.
double arc_of(double tangent) {
  constexpr int kLastPower = 21;
  const double t = half_angle_tangent(half_angle_tangent(tangent));
  const double square = t * t;
  double sum = 0;
  for (int power = kLastPower; power >= 3; power -= 2) sum = square * (1.0 / power - sum);
  return 4 * (t - t * sum);
}

}  // namespace

double arc_tangent(double y, double x) {
  const double across = std::abs(y), along = std::abs(x);
  if (across == 0 && along == 0) return 0;
  double angle =
      across <= along ? arc_of(across / along) : std::numbers::pi / 2 - arc_of(along / across);
  if (x < 0) angle = std::numbers::pi - angle;
  return std::copysign(angle, y);
}

double arc_cosine(double cosine) {
  return arc_tangent(std::sqrt((1 - cosine) * (1 + cosine)), cosine);
}

// The power series of an angle of at most an eighth of a turn.
CosineAndSine cosine_and_sine(double angle) {
  constexpr int kLastPower = 19;
  int quarters = 0;
  const double rest = std::remquo(angle, std::numbers::pi / 2, &quarters);
  const double square = rest * rest;
  double cosine = 1, sine = 1;
  for (int power = kLastPower; power >= 3; power -= 2) {
    cosine = 1 - square / ((power - 1) * (power - 2)) * cosine;
    sine = 1 - square / (power * (power - 1)) * sine;
  }
  sine *= rest;
  switch (quarters & 3) {
    case 0:
      return {cosine, sine};
    case 1:
      return {-sine, cosine};
    case 2:
      return {-cosine, -sine};
    default:
      return {sine, -cosine};
  }
}

}  // namespace meshrepair
