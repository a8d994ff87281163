// What the numbers in a file can hold.
#pragma once

#include <mesh/soup.h>

namespace meshrepair {

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
