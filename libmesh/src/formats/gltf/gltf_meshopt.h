// Buffer views compressed as EXT_meshopt_compression has it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include <mesh/mesh_source.h>

namespace meshrepair {

struct MeshoptLayout {
  std::size_t count = 0;
  std::size_t stride = 0;  // bytes of each
  std::string mode;        // ATTRIBUTES, TRIANGLES or INDICES
  std::string filter;      // NONE or nothing, OCTAHEDRAL, QUATERNION or EXPONENTIAL
};

// `count` times `stride` bytes. Throws InputError if they are not what the bytes stand for.
[[nodiscard]] std::string decode_meshopt(const MeshSource& source, std::string_view bytes,
                                         const MeshoptLayout& layout);

}  // namespace meshrepair
