// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>

#include <mesh/precision.h>

namespace meshrepair {

[[gnu::noinline]] double rounded_to_float32(double x) {
  return static_cast<double>(static_cast<float>(x));
}

Vec3d rounded_to_float32(const Vec3d& p) {
  return {rounded_to_float32(p.x()), rounded_to_float32(p.y()), rounded_to_float32(p.z())};
}

}  // namespace meshrepair

namespace meshrepair::internal {

double number_spacing(double x, Precision precision) {
  int exponent = 0;
  std::frexp(x, &exponent);
  const int digits = precision == Precision::float32 ? std::numeric_limits<float>::digits
                                                     : std::numeric_limits<double>::digits;
  return std::ldexp(1.0, exponent - digits);
}

double number_spacing(const TriangleSoup& mesh, Precision precision) {
  double largest = 0;
  for (const Vec3d& p : mesh.points) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  return number_spacing(largest, precision);
}

Vec3d rounded_to(const Vec3d& p, Precision precision) {
  return precision == Precision::float32 ? rounded_to_float32(p) : p;
}

}  // namespace meshrepair::internal
