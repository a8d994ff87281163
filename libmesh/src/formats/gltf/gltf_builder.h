// A glTF document in the making, with the bytes of its one buffer.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gltf_accessor.h"
#include "gltf_document.h"
#include "gltf_keepsake.h"

namespace meshrepair {

class GltfBuilder {
 public:
  // From nothing, or from what another file had.
  explicit GltfBuilder(const GltfKeepsake* kept);

  GltfJson& root() { return root_; }

  // What buffer views are for.
  enum class Target { none = 0, vertices = 34962, indices = 34963 };

  // Each returns the number of what was appended.
  std::size_t append(const char* list, GltfJson entry);
  std::size_t append_view(std::string_view bytes, Target target, std::size_t stride = 0);

  // Names an extension that is used.
  void use_extension(const std::string& name);

  // The bytes of the file. Throws OutputError if a .glb cannot be as long.
  [[nodiscard]] std::string finish(bool binary);

 private:
  std::size_t place(std::string_view bytes);

  GltfJson root_;
  std::string buffer_;
};

}  // namespace meshrepair
