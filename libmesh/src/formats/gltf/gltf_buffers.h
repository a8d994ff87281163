// SPDX-License-Identifier: MIT
// The bytes that a glTF file's buffer views stand for, also where EXT_meshopt_compression packs
// them.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>

#include <mesh/mesh_source.h>

#include "gltf_document.h"

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

// Buffers are read when a view of theirs is asked for: the binary chunk, data URIs, and files in
// the folder of the source or below it. Whatever is not there throws InputError.
class GltfBuffers {
 public:
  explicit GltfBuffers(const GltfDocument& document) : document_(document) {}

  // Lives as long as this. Decompressed if need be.
  std::string_view view(std::size_t number);

 private:
  // Either in the source, or owned.
  struct Bytes {
    std::string_view bytes;
    std::shared_ptr<const void> owner;
  };

  std::string_view buffer(std::size_t number);
  Bytes load(std::size_t number) const;
  std::string_view part(const GltfJson& view);
  std::string decompress(const GltfJson& compression);

  const GltfDocument& document_;
  std::unordered_map<std::size_t, Bytes> buffers_;
  std::unordered_map<std::size_t, std::string> decompressed_;
};

}  // namespace meshrepair
