// SPDX-License-Identifier: MIT
// Which triangles of a clean soup have the same corners.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include <base/ids.h>
#include <base/internal/hash_index.h>

namespace meshrepair::internal {

using CornerIds = std::array<PointId, 3>;

// The same for all triangles with these corners.
[[nodiscard]] inline CornerIds sorted_corners(CornerIds corners) {
  std::sort(corners.begin(), corners.end());
  return corners;
}

// Corners in another order have another hash.
[[nodiscard]] inline std::uint64_t hash_of_corners(const CornerIds& corners) {
  std::uint64_t hash = 0;
  for (const PointId corner : corners) hash = hash_mix(hash, corner.value);
  return hash;
}

// Whether triangles with the same three corners face the same way.
[[nodiscard]] inline bool same_orientation(const CornerIds& a, const CornerIds& b) {
  return (a[0] == b[0] && a[1] == b[1]) || (a[0] == b[1] && a[1] == b[2]) ||
         (a[0] == b[2] && a[1] == b[0]);
}

}  // namespace meshrepair::internal
