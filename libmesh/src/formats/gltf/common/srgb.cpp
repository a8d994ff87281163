// SPDX-License-Identifier: MIT
#include "srgb.h"

#include <cmath>

namespace meshrepair {
namespace {

// The standard's numbers: a line near black, which a power goes on with.
constexpr double kSlope = 12.92, kOffset = 0.055, kExponent = 2.4;
constexpr double kEndOfLineSrgb = 0.04045, kEndOfLineLinear = 0.0031308;

bool is_between(double value) { return value > 0 && value < 1; }

}  // namespace

double linear_of_srgb(double value) {
  if (!is_between(value)) return value;
  if (value <= kEndOfLineSrgb) return value / kSlope;
  return std::pow((value + kOffset) / (1 + kOffset), kExponent);
}

double srgb_of_linear(double value) {
  if (!is_between(value)) return value;
  if (value <= kEndOfLineLinear) return value * kSlope;
  return (1 + kOffset) * std::pow(value, 1 / kExponent) - kOffset;
}

}  // namespace meshrepair
