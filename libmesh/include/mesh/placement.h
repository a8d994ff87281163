// SPDX-License-Identifier: MIT
// Where an instance of a mesh stands.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

#include <base/vec3.h>

namespace meshrepair {

// From a mesh's frame to the world's.
struct Placement {
  Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();
  Vec3d offset = Vec3d::Zero();

  [[nodiscard]] bool is_identity() const;
  [[nodiscard]] Vec3d of(const Vec3d& point) const;
  // This one first, then the other.
  [[nodiscard]] Placement then(const Placement& next) const;
  // Inside and outside change places.
  [[nodiscard]] bool mirrors() const { return linear.determinant() < 0; }
};

}  // namespace meshrepair
