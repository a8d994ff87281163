// SPDX-License-Identifier: MIT
// What the numbers in a file can hold.
#pragma once

#include <mesh/soup.h>

namespace meshrepair {

// The nearest float32, as a double. Never inlined: g++ 12 leaves out this rounding for some
// elements when it vectorises several of them.
[[nodiscard]] double rounded_to_float32(double x);

// By coordinate.
[[nodiscard]] Vec3d rounded_to_float32(const Vec3d& p);

enum class Precision { float64, float32 };

namespace internal {

// The distance of neighbouring numbers at x. It grows with the magnitude of x.
[[nodiscard]] double number_spacing(double x, Precision precision);
// The same at the mesh's largest coordinate.
[[nodiscard]] double number_spacing(const TriangleSoup& mesh, Precision precision);

// The nearest point that can be written.
[[nodiscard]] Vec3d rounded_to(const Vec3d& p, Precision precision);

}  // namespace internal
}  // namespace meshrepair
