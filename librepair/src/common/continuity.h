// SPDX-License-Identifier: MIT
// How much values of neighbours may differ and still look like one.
#pragma once

#include <mesh/attributes.h>

namespace meshrepair::internal {

// The cosine of the angle from which on two triangles, or normals, look as with an edge between
// them.
inline constexpr double kCrease = 0.7;

// The largest of what its components span; 1 of directions.
[[nodiscard]] double extent_of(const CornerAttribute& attribute);

}  // namespace meshrepair::internal
