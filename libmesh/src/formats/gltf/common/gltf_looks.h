// SPDX-License-Identifier: MIT
// Materials of a glTF document, and what they need.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <mesh/attributes.h>

#include "gltf_json.h"

namespace meshrepair {

struct GltfLooks {
  // A document that has materials, textures, samplers and images. Its buffer views have no buffer.
  GltfJson root;
  std::vector<std::shared_ptr<const std::string>> views;  // the bytes of root["bufferViews"]
  std::vector<Image> images;                              // what root["images"] are
  // Of the number of a mesh (of joined ones 0) and a material (kNone: none): what its primitives
  // say of materials that they have in variants.
  std::map<std::pair<std::size_t, std::size_t>, GltfJson> variants;
};

// Appends the materials of `other` with all textures, samplers, images and names of extensions,
// each as it is but for the numbers of others in it. Of what is there already, with the same text
// and the same bytes, there is no second one, unless it has variants: those of `other` go. Returns
// the numbers that the materials have now.
[[nodiscard]] std::vector<std::size_t> append_looks(GltfLooks& all, const GltfLooks& other);

// Textures of all materials take the set of coordinates that has the number numbers[i] instead of
// i.
void renumber_texture_sets(GltfLooks& looks, const std::vector<std::uint32_t>& numbers);

}  // namespace meshrepair
