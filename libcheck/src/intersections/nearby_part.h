// SPDX-License-Identifier: MIT
// What of a soup is near some of its triangles, as a soup of its own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <mesh/soup.h>

namespace meshrepair::internal {

// Worth it for fewer than one in so many triangles.
inline constexpr std::size_t kFew = 4;

struct NearbyPart {
  TriangleSoup soup;
  std::vector<std::uint32_t> triangles;  // of each triangle, its number in the whole; ascending
  std::vector<std::uint32_t> among;      // the triangles it is near to, in its own numbers
};

// All that may meet one of `among`, which may repeat, or lie within `margin` of it.
[[nodiscard]] NearbyPart nearby_part(const TriangleSoup& soup, std::span<const std::uint32_t> among,
                                     double margin);

}  // namespace meshrepair::internal
