// SPDX-License-Identifier: MIT
// Does a closed surface face outward? Exactly.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include <base/vec3.h>

namespace meshrepair {

// The sign of the volume that those of the `triangles` enclose that `which` lists, which are
// closed: each edge is passed as often one way as the other. 1 if they are counter-clockwise seen
// from outside. The corners are indices into `points`; all coordinates are finite.
[[nodiscard]] int volume_sign(std::span<const Vec3d> points,
                              std::span<const std::array<std::uint32_t, 3>> triangles,
                              std::span<const std::uint32_t> which);

}  // namespace meshrepair
