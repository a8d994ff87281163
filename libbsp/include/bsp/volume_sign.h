// Does a closed surface face outward? Exactly.
#pragma once

#include <cstdint>
#include <span>

#include <bsp/soup.h>

namespace meshrepair {

// The sign of the volume that these triangles of the soup enclose, which are closed: each edge is
// passed as often one way as the other. 1 if they are counter-clockwise seen from outside. All
// coordinates are finite.
[[nodiscard]] int volume_sign(const TriangleSoup& soup, std::span<const std::uint32_t> triangles);

}  // namespace meshrepair
