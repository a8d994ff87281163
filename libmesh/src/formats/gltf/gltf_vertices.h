// SPDX-License-Identifier: MIT
// The vertices of one primitive that is to be written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <mesh/attributes.h>
#include <mesh/soup.h>

#include "gltf_accessor.h"
#include "gltf_keepsake.h"

namespace meshrepair {

// Of the vertices: positions, or what else they have.
struct GltfColumn {
  std::string name;  // "POSITION"
  GltfLayout layout;
  std::size_t stride = 0;  // a multiple of four
  std::string bytes;       // `stride` for each vertex
};

struct GltfVertices {
  std::vector<GltfColumn> columns;  // positions first
  std::vector<std::uint32_t> corners;
  std::size_t count = 0;
};

// What vertices have, whether or not their triangles ask for it.
struct GltfNeeds {
  std::size_t textures = 0;                // sets of texture coordinates
  std::span<const std::uint32_t> of_mesh;  // triangles: primitives of a mesh have joints and
                                           // targets all alike
};

// Of these triangles, in their order. Corners that have the same bytes in all columns share a
// vertex; vertices are in the order in which corners need them. `attributes` may be null; those
// that no corner has a value of are left out, except for so many sets of texture coordinates as the
// material needs, and joints and targets of the mesh; and where a corner alone has none it gets one
// that says nothing. Throws OutputError if a coordinate does not fit into single precision.
[[nodiscard]] GltfVertices make_vertices(const TriangleSoup& soup,
                                         std::span<const std::uint32_t> triangles,
                                         const Attributes* attributes, const GltfKeepsake* kept,
                                         const GltfNeeds& needs);

}  // namespace meshrepair
