// SPDX-License-Identifier: MIT
// Round bars along lines, and a lattice of square ones.
#pragma once

#include <cstdint>
#include <vector>

#include <mesh/soup.h>

namespace meshrepair::bench {

// Closed, with flat ends; 2 * sides * (points - 1) + 2 * (sides - 2) triangles. The line has two
// points or more and no sharp turns.
[[nodiscard]] TriangleSoup tube(const std::vector<Vec3d>& line, double radius, std::uint32_t sides);

// The edges of size^3 unit cubes as square bars of this thickness, one body without inner walls.
[[nodiscard]] TriangleSoup lattice_truss(std::uint32_t size, double thickness);

}  // namespace meshrepair::bench
