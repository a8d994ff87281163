// SPDX-License-Identifier: MIT
// A glTF document in the making: its nodes, and the bytes of its one buffer.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <mesh/scene.h>

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

// Instead of the number of a mesh that is not there.
inline constexpr std::size_t kNoGltfMesh = ~std::size_t{0};

// Appends a node without a parent to the scene that is shown, and returns its number. An empty name
// is left out.
std::size_t add_gltf_node(GltfBuilder& builder, GltfJson node);

// Appends a node for each instance; `numbers` are those that the meshes of the scene have. With a
// scale other than 1 there is a node above that has it.
void add_gltf_instances(GltfBuilder& builder, const Scene& scene,
                        const std::vector<std::size_t>& numbers, double scale);

// Has all nodes that name mesh m name mesh numbers[m].
void renumber_gltf_meshes(GltfBuilder& builder, const std::vector<std::size_t>& numbers);

}  // namespace meshrepair
