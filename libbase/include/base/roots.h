// SPDX-License-Identifier: MIT
// Roots and powers with the same bits on all systems. Those of C libraries differ: glibc's hypot()
// and cbrt() use fused multiply-add where each machine of an architecture has it, as on 64-bit ARM,
// and Eigen's stableNorm() sums in an order that depends on the address of the vector, and pow() of
// 10 is not always the nearest number.
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

// 10 to this power: the nearest number for exponents from -22 to 22.
[[nodiscard]] double power_of_ten(int exponent);
// The exponent of the largest power of ten that is not above x, which is positive and finite.
[[nodiscard]] int decimal_exponent(double x);

}  // namespace meshrepair
