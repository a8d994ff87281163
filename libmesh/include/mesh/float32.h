// Rounding to the numbers that 32 bits can hold.
#pragma once

#include <mesh/soup.h>

namespace meshrepair {

// The nearest float32, as a double. Never inlined: g++ 12 leaves out this rounding for some
// elements when it vectorises several of them.
[[nodiscard]] double rounded_to_float32(double x);

// By coordinate.
[[nodiscard]] Vec3d rounded_to_float32(const Vec3d& p);

}  // namespace meshrepair
