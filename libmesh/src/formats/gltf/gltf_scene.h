// SPDX-License-Identifier: MIT
// Where the meshes of a glTF file stand.
#pragma once

#include <cstddef>
#include <vector>

#include <mesh/placement.h>

#include "gltf_buffers.h"
#include "gltf_document.h"

namespace meshrepair {

struct GltfInstance {
  std::size_t node = 0;
  std::size_t mesh = 0;
  bool has_skin = false;   // stands where it is, without joints
  bool is_hidden = false;  // or a node above it
  Placement placement;
};

// Whether the node says that it and all below it are not to be seen.
[[nodiscard]] bool is_gltf_hidden(const GltfJson& node);

// Of the default scene; else of the first; else of all nodes without parents. Parents come before
// children, children in their order. Throws InputError if nodes are missing or no tree.
[[nodiscard]] std::vector<GltfInstance> read_scene(const GltfDocument& document,
                                                   GltfBuffers& buffers);

}  // namespace meshrepair
