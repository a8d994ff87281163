// SPDX-License-Identifier: MIT
// The stages of the exact predicates, one by one, for the predicates and for their own test.
#pragma once

#include <array>

#include <exact/plane.h>
#include <exact/wide_int.h>

namespace meshrepair::internal {

// The common point of three planes in homogeneous coordinates: position = numerator / denominator.
struct Homogeneous {
  std::array<Int256, 3> numerator;
  Int256 denominator;  // 0: the planes have no single common point
};

[[nodiscard]] Homogeneous meet_exactly(const Plane& a, const Plane& b, const Plane& c);

// Sign of normal . position + offset in 256 bits. The denominator is not 0.
[[nodiscard]] int side_exactly(const Homogeneous& point, const Plane& plane);

// Cramer's rule in doubles. `error` bounds each coordinate's error; it is infinite where nothing is
// known.
struct Approximation {
  std::array<double, 3> position;
  double error;
};

[[nodiscard]] Approximation meet_approximately(const Plane& a, const Plane& b, const Plane& c);

}  // namespace meshrepair::internal
