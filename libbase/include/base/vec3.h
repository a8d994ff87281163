// SPDX-License-Identifier: MIT
// The vector type: points, differences and normals.
#pragma once

#include <Eigen/Core>

namespace meshrepair {

using Vec3d = Eigen::Vector3d;

}  // namespace meshrepair
