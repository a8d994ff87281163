#include "model_part.h"

namespace meshrepair {

Vec3d Placement::of(const Vec3d& p) const {
  if (identity) return p;
  return {p.x() * m[0] + p.y() * m[3] + p.z() * m[6] + m[9],
          p.x() * m[1] + p.y() * m[4] + p.z() * m[7] + m[10],
          p.x() * m[2] + p.y() * m[5] + p.z() * m[8] + m[11]};
}

Placement Placement::then(const Placement& next) const {
  if (identity) return next;
  if (next.identity) return *this;
  Placement both;
  both.identity = false;
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      double sum = row == 3 ? next.m[9 + column] : 0;
      for (std::size_t k = 0; k < 3; ++k) sum += m[3 * row + k] * next.m[3 * k + column];
      both.m[3 * row + column] = sum;
    }
  }
  return both;
}

bool Placement::mirrors() const {
  const double determinant = m[0] * (m[4] * m[8] - m[5] * m[7]) -
                             m[1] * (m[3] * m[8] - m[5] * m[6]) +
                             m[2] * (m[3] * m[7] - m[4] * m[6]);
  return determinant < 0;
}

}  // namespace meshrepair
