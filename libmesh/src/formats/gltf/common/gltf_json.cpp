// SPDX-License-Identifier: MIT
#include "gltf_json.h"

#include <cstdint>
#include <limits>

#include <mesh/mesh_source.h>

namespace meshrepair {

const GltfJson* gltf_member(const GltfJson& object, const char* key) {
  if (!object.is_object()) return nullptr;
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

const GltfJson* gltf_extension(const GltfJson& object, const char* name) {
  const GltfJson* const extensions = gltf_member(object, "extensions");
  return extensions == nullptr ? nullptr : gltf_member(*extensions, name);
}

std::size_t gltf_whole(const GltfJson& number) {
  return within(number.get<std::uint64_t>(), std::numeric_limits<std::size_t>::max());
}

std::string gltf_text(const GltfJson& object, const char* key) {
  const GltfJson* const value = gltf_member(object, key);
  return value != nullptr && value->is_string() ? value->get<std::string>() : std::string();
}

}  // namespace meshrepair
