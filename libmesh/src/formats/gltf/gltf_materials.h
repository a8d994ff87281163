// SPDX-License-Identifier: MIT
// The materials and images of a glTF file, as all formats have them.
#pragma once

#include <cstddef>
#include <string>

#include <mesh/attributes.h>

#include "gltf_buffers.h"
#include "gltf_document.h"

namespace meshrepair {

// Of samplers.
inline constexpr std::size_t kGltfNearest = 9728;
inline constexpr std::size_t kGltfLinear = 9729;
inline constexpr std::size_t kGltfRepeat = 10497;
inline constexpr std::size_t kGltfClamp = 33071;
inline constexpr std::size_t kGltfMirror = 33648;

// All of them, in their order: the names of `materials`, one for each, all different; `looks`;
// `images`, of which nothing is decoded. Throws InputError.
void read_materials(const GltfDocument& document, GltfBuffers& buffers, Attributes& attributes);

// Of an image that has bytes: what the file says, or else the first of its bytes.
[[nodiscard]] std::string media_type_of(const Image& image);

// How many sets of texture coordinates a mesh has to have for a material.
[[nodiscard]] std::size_t needed_textures(const GltfJson& material);

}  // namespace meshrepair
