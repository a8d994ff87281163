// SPDX-License-Identifier: MIT
// The triangle soup: what every reader returns and every writer takes.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <base/vec3.h>

namespace meshrepair {

// Points in the units of the file, and triangles as triples of 0-based indices into `points`.
// Nothing else is promised: triangles may repeat, cross, have equal corners; points may be unused
// or not finite. Every index is smaller than points.size().
struct TriangleSoup {
  std::vector<Vec3d> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

}  // namespace meshrepair
