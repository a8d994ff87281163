// SPDX-License-Identifier: MIT
// The largest meshes and point clouds: points, and the sides of triangles, three to each, are
// numbered in 32 bits, and one number stands for none.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

#include <base/ids.h>

namespace meshrepair {

inline constexpr std::size_t kMostPoints = std::numeric_limits<std::uint32_t>::max() - 1;
inline constexpr std::size_t kMostTriangles = TriangleId::Kind::kMost;

// Throw LimitError where there are more. The message begins with the name, if there is one.
void require_points(std::uint64_t points, const std::string& name = {});
void require_triangles(std::uint64_t triangles, const std::string& name = {});

}  // namespace meshrepair
