// SPDX-License-Identifier: MIT
// The repaired mesh.
#pragma once

#include <cstdint>
#include <vector>

#include <mesh/mesh_parts.h>
#include <mesh/soup.h>

namespace meshrepair {

// Triangles counter-clockwise seen from outside the solid. As an indexed mesh it is closed and
// 2-manifold: each edge has two triangles that pass it in opposite directions, each vertex one fan.
// Where parts touch, or one part itself, points have equal coordinates and different indices.
struct Surface {
  static constexpr std::uint32_t kNoSource = ~std::uint32_t{0};

  TriangleSoup mesh;
  // For each triangle the index of the input triangle that it lies in, or of one of them where
  // triangles of one plane were cut and merged; kNoSource where a gap was closed.
  std::vector<std::uint32_t> source;
  // For each point whether it is one of the input's, with its coordinates.
  std::vector<char> input_point;
};

// Those with a flag, one for each, and the points that they have, all in their order.
void keep_triangles(Surface& surface, const std::vector<char>& keep);

// Of a triangle that is in no group.
inline constexpr std::uint32_t kNoGroup = ~std::uint32_t{0};

// The triangles of each group, and the points that they have, all in their order. No two groups
// have a point in common.
[[nodiscard]] std::vector<Surface> divide_surface(const Surface& surface, const MeshParts& groups);

// The triangles and points of another one behind those that are there.
void append_surface(Surface& all, const Surface& other);

}  // namespace meshrepair
