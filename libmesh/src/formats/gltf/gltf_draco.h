// SPDX-License-Identifier: MIT
// Primitives compressed as KHR_draco_mesh_compression has it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include <mesh/mesh_source.h>

#include "gltf_accessor.h"

namespace meshrepair {

struct DracoMesh {
  std::vector<std::uint32_t> corners;    // three for each triangle
  std::vector<GltfAccessor> attributes;  // those asked for, in that order
};

// What of an attribute is wanted: its number in the bytes, and whether its integers are shares.
struct DracoAttribute {
  std::uint32_t id = 0;
  bool normalized = false;
};

// Throws InputError if the bytes are broken, or promise more than `most_triangles`, or far more
// than so many bytes can hold.
[[nodiscard]] DracoMesh decode_draco(const MeshSource& source, std::string_view bytes,
                                     std::size_t most_triangles,
                                     const std::vector<DracoAttribute>& attributes);

}  // namespace meshrepair
