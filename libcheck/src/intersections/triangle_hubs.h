// SPDX-License-Identifier: MIT
// Vertices and edges with very many triangles, around which boxes tell nothing apart.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <base/ids.h>
#include <check/box_tree.h>
#include <check/internal/triangle_list.h>
#include <check/internal/triangle_pair.h>

namespace meshrepair::internal {

// For each triangle the corner that most triangles share, if these are very many, or kNone; empty
// if there are none.
[[nodiscard]] std::vector<std::uint32_t> find_hubs(const TriangleList& triangles);

// A box around the directions in which a triangle is seen from one of its corners. If two triangles
// with that corner have another point in common, these boxes meet.
[[nodiscard]] Box directions_from(std::uint32_t hub, const CornerTriangle& triangle);

// As find_hubs(), for triangles that all have the corner `hub`: which of their other two corners.
[[nodiscard]] std::vector<std::uint32_t> find_second_hubs(
    std::uint32_t hub, std::span<const CornerTriangle> triangles);

// A box around the direction, square to an edge of a triangle, in which its third corner lies. If
// two triangles with that edge have a point beyond it in common, these boxes meet.
[[nodiscard]] Box direction_across(std::array<std::uint32_t, 2> edge,
                                   const CornerTriangle& triangle);

}  // namespace meshrepair::internal
