// SPDX-License-Identifier: MIT
// Where a corner of a mesh with fewer triangles has its values from.
#pragma once

#include <cstdint>

#include <base/vec3.h>

namespace meshrepair {

// A place on a triangle of the input.
struct CornerOrigin {
  std::uint32_t source = ~std::uint32_t{0};  // all ones: see Surface::source
  bool turned = false;                       // the result faces the other way there
  Vec3d place = Vec3d::Zero();
};

}  // namespace meshrepair
