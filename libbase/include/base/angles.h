// SPDX-License-Identifier: MIT
// Angles, in radians, with the same bits on all systems. The trigonometric functions of C
// libraries differ in the last places, and glibc's with the processor.
#pragma once

namespace meshrepair {

// Of the vector (x, y), from -pi to pi: what std::atan2(y, x) is, off by at most 8 in the last
// place. Expects finite numbers.
[[nodiscard]] double arc_tangent(double y, double x);

// From 0 to pi. Expects a number from -1 to 1.
[[nodiscard]] double arc_cosine(double cosine);

struct CosineAndSine {
  double cosine, sine;
};

// Off by at most 2^-49 for angles of a few turns. Not numbers if the angle is infinite or is none.
[[nodiscard]] CosineAndSine cosine_and_sine(double angle);

}  // namespace meshrepair
