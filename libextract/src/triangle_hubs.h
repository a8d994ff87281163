// Vertices with very many triangles, around which boxes tell nothing apart.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <extract/box_tree.h>

#include "triangle_pair.h"

namespace meshrepair::internal {

inline constexpr std::uint32_t kNoHub = ~std::uint32_t{0};

// For each triangle the corner that most triangles share, if these are very many, or kNoHub.
[[nodiscard]] std::vector<std::uint32_t> find_hubs(std::span<const CornerTriangle> triangles);

// A box around the directions in which a triangle is seen from one of its corners. If two triangles
// with that corner have another point in common, these boxes meet.
[[nodiscard]] Box directions_from(std::uint32_t hub, const CornerTriangle& triangle);

}  // namespace meshrepair::internal
