// SPDX-License-Identifier: MIT
// glTF files for tests, put together piece by piece, right or wrong.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace meshrepair {

using TestJson = nlohmann::json;

template <class Number>
std::string bytes_of(const std::vector<Number>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)};
}

// As accessors number them.
constexpr int component_of(std::int8_t) { return 5120; }
constexpr int component_of(std::uint8_t) { return 5121; }
constexpr int component_of(std::int16_t) { return 5122; }
constexpr int component_of(std::uint16_t) { return 5123; }
constexpr int component_of(std::uint32_t) { return 5125; }
constexpr int component_of(float) { return 5126; }

class GltfMaker {
 public:
  TestJson root = {{"asset", {{"version", "2.0"}}}};
  std::string buffer;

  std::size_t add(const char* list, TestJson entry) {
    root[list].push_back(std::move(entry));
    return root[list].size() - 1;
  }

  std::size_t add_view(const std::string& bytes, std::size_t stride = 0) {
    buffer.append((4 - buffer.size() % 4) % 4, '\0');
    TestJson view = {{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes.size()}};
    if (stride > 0) view["byteStride"] = stride;
    buffer += bytes;
    return add("bufferViews", std::move(view));
  }

  // Of numbers one after the other.
  template <class Number>
  std::size_t add_accessor(const std::vector<Number>& numbers, const std::string& type,
                           bool normalized = false) {
    const std::size_t components = type == "SCALAR" ? 1 : static_cast<std::size_t>(type[3] - '0');
    TestJson accessor = {{"bufferView", add_view(bytes_of(numbers))},
                         {"componentType", component_of(Number())},
                         {"count", numbers.size() / components},
                         {"type", type}};
    if (normalized) accessor["normalized"] = true;
    return add("accessors", std::move(accessor));
  }

  // A mesh of one primitive, and a node that has it, in the scene.
  TestJson& add_mesh(std::size_t positions, std::optional<std::size_t> indices = std::nullopt) {
    TestJson primitive = {{"attributes", {{"POSITION", positions}}}};
    if (indices) primitive["indices"] = *indices;
    const std::size_t mesh = add("meshes", {{"primitives", {primitive}}});
    add_root({{"mesh", mesh}});
    return root["meshes"][mesh]["primitives"][0];
  }

  // A node in the scene.
  std::size_t add_root(TestJson node) {
    const std::size_t number = add("nodes", std::move(node));
    if (!root.contains("scenes")) root["scenes"] = {{{"nodes", TestJson::array()}}};
    root["scenes"][0]["nodes"].push_back(number);
    return number;
  }

  [[nodiscard]] std::string glb() const {
    TestJson whole = root;
    if (!whole.contains("buffers") && !buffer.empty()) {
      whole["buffers"] = {{{"byteLength", buffer.size()}}};
    }
    return glb_of(whole.dump(), buffer);
  }

  // With these buffers.
  [[nodiscard]] std::string gltf(const std::string& uri) const {
    TestJson whole = root;
    whole["buffers"] = {{{"byteLength", buffer.size()}, {"uri", uri}}};
    return whole.dump();
  }

  static std::string glb_of(std::string json, std::string binary) {
    json.append((4 - json.size() % 4) % 4, ' ');
    binary.append((4 - binary.size() % 4) % 4, '\0');
    const std::size_t size = 12 + 8 + json.size() + (binary.empty() ? 0 : 8 + binary.size());
    std::string bytes = "glTF" + uint32(2) + uint32(size) + uint32(json.size()) + "JSON" + json;
    if (!binary.empty()) bytes += uint32(binary.size()) + std::string("BIN\0", 4) + binary;
    return bytes;
  }

  static std::string uint32(std::size_t value) {
    return bytes_of(std::vector<std::uint32_t>{static_cast<std::uint32_t>(value)});
  }
};

// One triangle: (0,0,0), (1,0,0), (0,1,0).
inline GltfMaker one_triangle() {
  GltfMaker maker;
  const std::size_t positions = maker.add_accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  const std::size_t indices = maker.add_accessor<std::uint16_t>({0, 1, 2}, "SCALAR");
  maker.add_mesh(positions, indices);
  return maker;
}

}  // namespace meshrepair
