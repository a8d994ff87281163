// SPDX-License-Identifier: MIT
// A glTF file taken apart: its JSON, and the binary chunk of a .glb.
//
// A .glb, all numbers little endian:
//
//   offset  size  content
//        0     4  "glTF"
//        4     4  uint32: 2, the version
//        8     4  uint32: size of the file
//       12     8  uint32 x 2: size of the first chunk, "JSON"
//       20        its bytes; then chunks of the same layout, of which "BIN\0" is the first buffer
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include <mesh/mesh_source.h>

#include "common/gltf_json.h"

namespace meshrepair {

// Is of the source, which has to live as long. Whatever is not as it has to be throws InputError.
class GltfDocument {
 public:
  // Refuses other versions, and files that need an extension that is not known here.
  explicit GltfDocument(const MeshSource& source);

  [[nodiscard]] const MeshSource& source() const { return source_; }
  [[nodiscard]] const GltfJson& root() const { return root_; }
  [[nodiscard]] std::optional<std::string_view> binary() const { return binary_; }
  [[nodiscard]] bool is_binary() const { return is_binary_; }
  // Behind the file, as its header has its size.
  [[nodiscard]] std::size_t trailing_bytes() const { return trailing_bytes_; }

  // Of a list at the top, "accessors". No list has no entries.
  [[nodiscard]] std::size_t count(const char* list) const;
  [[nodiscard]] const GltfJson& entry(const char* list, std::size_t number) const;

  // A member that is a whole number from 0 on, if there is one.
  [[nodiscard]] std::optional<std::size_t> whole(const GltfJson& object, const char* key) const;
  [[nodiscard]] std::size_t whole(const GltfJson& object, const char* key,
                                  std::size_t otherwise) const;
  [[nodiscard]] std::size_t required_whole(const GltfJson& object, const char* key) const;
  // A whole number in a list.
  [[nodiscard]] std::size_t whole_of(const GltfJson& value, const char* what) const;

 private:
  std::string_view take_chunks();
  void parse(std::string_view text);
  void check_version() const;
  void check_extensions() const;

  const MeshSource& source_;
  GltfJson root_;
  std::optional<std::string_view> binary_;
  bool is_binary_ = false;
  std::size_t trailing_bytes_ = 0;
};

}  // namespace meshrepair
