#include <mesh/float32.h>

namespace meshrepair {

[[gnu::noinline]] double rounded_to_float32(double x) {
  return static_cast<double>(static_cast<float>(x));
}

Vec3d rounded_to_float32(const Vec3d& p) {
  return {rounded_to_float32(p.x()), rounded_to_float32(p.y()), rounded_to_float32(p.z())};
}

}  // namespace meshrepair
