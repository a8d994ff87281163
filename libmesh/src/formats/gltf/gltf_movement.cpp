// SPDX-License-Identifier: MIT
#include "gltf_movement.h"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <utility>

namespace meshrepair {
namespace {

class Settler {
 public:
  explicit Settler(GltfBuilder& builder) : builder_(builder), root_(builder.root()) {}

  void run() {
    const std::size_t nodes = size_of("nodes");
    for (std::size_t n = 0; n < size_of("meshes"); ++n) {
      drop_weights(root_["meshes"][n], targets_of(n));
    }
    for (std::size_t n = 0; n < nodes; ++n) {
      GltfJson& node = root_["nodes"][n];
      if (!node.is_object()) continue;
      const GltfJson* const mesh = gltf_member(node, "mesh");
      drop_weights(node, mesh == nullptr ? 0 : targets_of(gltf_whole(*mesh)));
      if (node.contains("skin")) settle_skin(n);
    }
    settle_animations();
  }

 private:
  [[nodiscard]] std::size_t size_of(const char* list) const {
    const GltfJson* const entries = gltf_member(root_, list);
    return entries == nullptr || !entries->is_array() ? 0 : entries->size();
  }

  [[nodiscard]] const GltfJson* first_primitive(std::size_t mesh) const {
    if (mesh >= size_of("meshes")) return nullptr;
    const GltfJson& primitives = root_["meshes"][mesh]["primitives"];
    return primitives.empty() ? nullptr : &primitives[0];
  }

  // Primitives of a mesh have as many.
  [[nodiscard]] std::size_t targets_of(std::size_t mesh) const {
    const GltfJson* const primitive = first_primitive(mesh);
    const GltfJson* const targets =
        primitive == nullptr ? nullptr : gltf_member(*primitive, "targets");
    return targets == nullptr ? 0 : targets->size();
  }

  static void drop_weights(GltfJson& object, std::size_t targets) {
    const GltfJson* const weights = gltf_member(object, "weights");
    if (weights != nullptr && (targets == 0 || weights->size() != targets)) object.erase("weights");
  }

  [[nodiscard]] bool has_joints(std::size_t mesh) const {
    const GltfJson* const primitive = first_primitive(mesh);
    return primitive != nullptr && (*primitive)["attributes"].contains("JOINTS_0");
  }

  void settle_skin(std::size_t number) {
    GltfJson& node = root_["nodes"][number];
    const GltfJson* const mesh = gltf_member(node, "mesh");
    const GltfJson& skin = node["skin"];
    const bool is_there = skin.is_number_unsigned() && gltf_whole(skin) < size_of("skins");
    if (mesh != nullptr && is_there && has_joints(gltf_whole(*mesh))) return;
    node.erase("skin");
    if (mesh != nullptr) stand_apart(number, gltf_whole(*mesh));
  }

  // This adds a node, so others move in memory.
  void stand_apart(std::size_t number, std::size_t mesh) {
    GltfJson& node = root_["nodes"][number];
    GltfJson apart = {{"mesh", mesh}};
    for (const char* key : {"name", "weights"}) {
      if (node.contains(key)) apart[key] = node[key];
    }
    node.erase("mesh");
    node.erase("weights");
    if (size_of("scenes") == 0) {
      (void)builder_.append("nodes", std::move(apart));
    } else {
      (void)add_gltf_node(builder_, std::move(apart));
    }
  }

  [[nodiscard]] bool moves_nothing(const GltfJson& channel) const {
    const GltfJson* const target = gltf_member(channel, "target");
    if (target == nullptr || gltf_text(*target, "path") != "weights") return false;
    const GltfJson* const number = gltf_member(*target, "node");
    if (number == nullptr) return false;
    const std::size_t node = number->is_number_unsigned() ? gltf_whole(*number) : size_of("nodes");
    if (node >= size_of("nodes")) return true;
    const GltfJson* const mesh = gltf_member(root_["nodes"][node], "mesh");
    return mesh == nullptr || targets_of(gltf_whole(*mesh)) == 0;
  }

  void settle_animations() {
    if (size_of("animations") == 0) return;
    GltfJson kept = GltfJson::array();
    for (GltfJson& animation : root_["animations"]) {
      GltfJson& channels = animation["channels"];
      GltfJson moving = GltfJson::array();
      for (GltfJson& channel : channels) {
        if (!moves_nothing(channel)) moving.push_back(std::move(channel));
      }
      channels = std::move(moving);
      if (!channels.empty()) kept.push_back(std::move(animation));
    }
    root_["animations"] = std::move(kept);
    if (root_["animations"].empty()) root_.erase("animations");
  }

  GltfBuilder& builder_;
  GltfJson& root_;
};

}  // namespace

void add_gltf_values(GltfBuilder& builder, const std::string& name, std::size_t accessor,
                     std::size_t count, GltfJson& primitive) {
  if (!name.starts_with(kGltfTarget)) {
    primitive["attributes"][name] = accessor;
    return;
  }
  const std::string_view rest = std::string_view(name).substr(std::string_view(kGltfTarget).size());
  std::size_t number = 0;
  (void)std::from_chars(rest.data(), rest.data() + rest.size(), number);
  GltfJson& targets = primitive["targets"];
  if (!targets.is_array()) targets = GltfJson::array();
  // One that adds nothing has to say so.
  while (targets.size() <= number) {
    const bool is_last = targets.size() == number;
    targets.push_back(GltfJson::object());
    if (is_last) continue;
    targets.back()["POSITION"] = builder.append(
        "accessors", {{"componentType", static_cast<std::uint32_t>(GltfComponent::real32)},
                      {"count", count},
                      {"type", "VEC3"},
                      {"min", {0, 0, 0}},
                      {"max", {0, 0, 0}}});
  }
  targets[number][name.substr(name.find('/') + 1)] = accessor;
}

void settle_gltf_movement(GltfBuilder& builder) { Settler(builder).run(); }

}  // namespace meshrepair
