// SPDX-License-Identifier: MIT
// The JSON of glTF.
#pragma once

#include <cstddef>
#include <string>

#include <nlohmann/json.hpp>

namespace meshrepair {

using GltfJson = nlohmann::json;

// Of primitives: which materials they have in which variants of the scene.
inline constexpr const char* kGltfVariants = "KHR_materials_variants";

// The member of an object, or null if it has none or is no object.
[[nodiscard]] const GltfJson* gltf_member(const GltfJson& object, const char* key);
[[nodiscard]] const GltfJson* gltf_extension(const GltfJson& object, const char* name);
// What is_number_unsigned(); the largest number that counts where it is larger than any memory.
[[nodiscard]] std::size_t gltf_whole(const GltfJson& number);
// The text that a member is, or nothing.
[[nodiscard]] std::string gltf_text(const GltfJson& object, const char* key);

}  // namespace meshrepair
