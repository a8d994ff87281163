// The bytes that a glTF file's buffer views stand for.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>

#include "gltf_document.h"

namespace meshrepair {

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
