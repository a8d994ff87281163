// SPDX-License-Identifier: MIT
// Skins, weights of morph targets and what animates them, in a document that is written.
#pragma once

#include <cstddef>
#include <string>

#include "gltf_builder.h"

namespace meshrepair {

// "TARGET_3/NORMAL" is of the target 3.
inline constexpr const char* kGltfTarget = "TARGET_";

// Of a primitive that has so many vertices: the accessor of what vertices have, or of what a morph
// target adds to it.
void add_gltf_values(GltfBuilder& builder, const std::string& name, std::size_t accessor,
                     std::size_t count, GltfJson& primitive);

// Takes away what no longer fits its meshes: skins where vertices have no joints, weights where
// there are not as many targets, and animations of such weights. A mesh whose node loses its skin
// stands apart, where it stood: joints moved it, its node did not.
void settle_gltf_movement(GltfBuilder& builder);

}  // namespace meshrepair
