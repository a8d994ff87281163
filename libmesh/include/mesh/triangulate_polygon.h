// SPDX-License-Identifier: MIT
// Cuts a polygon in space into triangles.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <mesh/soup.h>

namespace meshrepair {

// Appends the triangles of the polygon with the given corners (at least 3, positions in `points`),
// in its orientation, as positions in `corners`. Corners equal to their predecessor are left out as
// long as three remain; n corners give n - 2 triangles. The polygon is seen along its area vector:
// one of up to 32 corners that is star-shaped from its first corner gives the fan of that corner,
// any other simple polygon is cut ear by ear. What is not all ears (it crosses itself, has no area,
// is not finite) gives the fan, or where it has more than 32 corners, its ears and the fan of what
// is left: the triangles may overlap, but their signed areas still add up to the polygon. Time as
// for clip_ears().
void triangulate_polygon(const std::vector<Vec3d>& points, std::span<const std::uint32_t> corners,
                         std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace meshrepair
