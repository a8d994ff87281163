// SPDX-License-Identifier: MIT
// Roots with the same bits on all systems. Those of the C library differ: glibc's hypot() and
// cbrt() use fused multiply-add where each machine of an architecture has it, as on 64-bit ARM, and
// Eigen's stableNorm() sums in an order that depends on the address of the vector.
#pragma once

#include <base/vec3.h>

namespace meshrepair {

// The length of the vector (x, y), without overflow or underflow on the way: off by less than 1 in
// the last place. Infinite if x or y is, else not a number if x or y is not.
[[nodiscard]] double hypotenuse(double x, double y);

// Without overflow or underflow on the way. Infinite or not a number if a coordinate is.
[[nodiscard]] double stable_length(const Vec3d& vector);

// Off by at most 1 in the last place. The cube root of the cube of a number of up to 17 bits is
// that number.
[[nodiscard]] double cube_root(double x);

}  // namespace meshrepair
