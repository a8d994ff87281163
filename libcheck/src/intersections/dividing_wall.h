// SPDX-License-Identifier: MIT
// A plane along a triangle, to tell thin triangles apart that no axis-parallel plane divides.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "clipped_triangle.h"

namespace meshrepair::internal {

// Of the planes of the offered triangles and those that stand on their edges, the one that cuts few
// of `judges` and leaves about as many on each side; nothing if none is of use. Not exact, and need
// not be: any wall is right.
[[nodiscard]] std::optional<Wall> choose_wall(std::span<const std::array<Vec3d, 3>> offered,
                                              std::span<const ClippedTriangle> judges);

}  // namespace meshrepair::internal
