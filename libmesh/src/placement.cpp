// SPDX-License-Identifier: MIT
#include <mesh/placement.h>

namespace meshrepair {

bool Placement::is_identity() const {
  return linear == Eigen::Matrix3d::Identity() && offset == Vec3d::Zero();
}

Vec3d Placement::of(const Vec3d& point) const {
  Vec3d result;
  for (int row = 0; row < 3; ++row) {
    result[row] = linear(row, 0) * point.x() + linear(row, 1) * point.y() +
                  linear(row, 2) * point.z() + offset[row];
  }
  return result;
}

Placement Placement::then(const Placement& next) const {
  if (next.is_identity()) return *this;
  return {next.linear * linear, next.of(offset)};
}

}  // namespace meshrepair
