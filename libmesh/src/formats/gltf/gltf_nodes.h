// The nodes of a glTF document in the making.
#pragma once

#include <cstddef>
#include <vector>

#include <mesh/scene.h>

#include "gltf_builder.h"

namespace meshrepair {

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
