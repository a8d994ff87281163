// SPDX-License-Identifier: MIT
// The triangles of one primitive of a glTF mesh.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <mesh/reading.h>

#include "gltf_accessor.h"

namespace meshrepair {

struct GltfPrimitive {
  GltfAccessor positions;
  // Of the accessors, those in use, in the order in which triangles name them.
  std::vector<std::uint32_t> vertices;
  std::vector<std::uint32_t> corners;  // positions in `vertices`, three for each triangle
  // What else vertices have, by its name in the file: as many values as there are positions.
  std::vector<std::pair<std::string, GltfAccessor>> attributes;
  std::optional<std::size_t> material;
  const GltfJson* variants = nullptr;  // which materials it has in which; of the document

  [[nodiscard]] std::size_t triangles() const { return corners.size() / 3; }
};

// What primitives have that is passed over.
struct GltfOddities {
  std::size_t not_triangles = 0;      // primitives of points or lines
  std::size_t without_positions = 0;  // primitives
  std::size_t bad_triangles = 0;      // that name vertices that are not there
  std::size_t morphed = 0;            // primitives with targets

  void report(ReadReport& report) const;
};

// Nothing if it has no triangles. Throws InputError, and LimitError beyond the triangles of the
// source's options.
[[nodiscard]] std::optional<GltfPrimitive> read_primitive(const GltfDocument& document,
                                                          GltfBuffers& buffers,
                                                          const GltfJson& primitive,
                                                          GltfOddities& oddities);

}  // namespace meshrepair
