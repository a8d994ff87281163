// SPDX-License-Identifier: MIT
#include "gltf_keepsake.h"

#include <algorithm>
#include <bit>
#include <string_view>
#include <unordered_map>
#include <utility>

#include <base/error.h>

#include "formats/common/uri.h"
#include "gltf_materials.h"
#include "gltf_scene.h"

namespace meshrepair {
namespace {

// Of how triangles were stored, and of what names them: no longer true.
constexpr std::array<std::string_view, 6> kOfMeshes = {
    "KHR_mesh_quantization", "KHR_draco_mesh_compression", "EXT_meshopt_compression",
    "EXT_mesh_features",     "EXT_instance_features",      "EXT_structural_metadata"};

// Of what stands where.
constexpr const char* kInstancing = "EXT_mesh_gpu_instancing";

// glTF has no empty objects and lists.
void erase_if_empty(GltfJson& object, const char* key) {
  const auto found = object.find(key);
  if (found != object.end() && found->empty()) object.erase(found);
}

// Than colour, opacity and picture, which all formats with materials have.
bool says_more_than_looks(const GltfJson& material) {
  if (!material.is_object()) return false;
  for (const auto& [key, value] : material.items()) {
    if (key == "pbrMetallicRoughness" && value.is_object()) {
      for (const auto& [inner, ignored] : value.items()) {
        if (inner != "baseColorFactor" && inner != "baseColorTexture") return true;
      }
    } else if (key != "name" && key != "alphaMode" && key != "doubleSided") {
      return true;
    }
  }
  return false;
}

class KeepsakeMaker {
 public:
  KeepsakeMaker(const GltfDocument& document, GltfBuffers& buffers, const Attributes& attributes,
                GltfKept what)
      : document_(document),
        buffers_(buffers),
        attributes_(attributes),
        what_(what),
        kept_(std::make_shared<GltfKeepsake>()) {
    kept_->has_scene = what.scene;
  }

  std::shared_ptr<GltfKeepsake> run() {
    copy_root();
    keep_nodes();
    if (what_.scene) keep_scene();
    if (what_.looks) {
      kept_->images = attributes_.images;
      keep_images();
    }
    keep_skins();
    keep_animations();
    keep_extensions();
    if (!accessors_.empty()) root()["accessors"] = std::move(accessors_);
    if (!views_.empty()) root()["bufferViews"] = std::move(views_);
    kept_->materials = attributes_.materials.names;
    return std::move(kept_);
  }

 private:
  GltfJson& root() { return kept_->root; }

  void copy_root() {
    constexpr std::array<std::string_view, 5> kLeftOut = {"meshes", "skins", "accessors",
                                                          "bufferViews", "buffers"};
    root() = GltfJson::object();
    for (const auto& [key, value] : document_.root().items()) {
      if (std::find(kLeftOut.begin(), kLeftOut.end(), key) == kLeftOut.end()) root()[key] = value;
    }
    if (what_.looks) return;
    for (const char* key : {"materials", "textures", "images", "samplers"}) root().erase(key);
  }

  void keep_nodes() {
    if (document_.count("nodes") == 0) return;
    for (GltfJson& node : root()["nodes"]) {
      if (!node.is_object()) continue;
      if (!what_.scene) {
        for (const char* key : {"mesh", "skin", "weights"}) node.erase(key);
      }
      drop_extensions(node);
    }
  }

  void keep_scene() {
    for (std::size_t i = 0; i < document_.count("meshes"); ++i) {
      GltfJson mesh = document_.entry("meshes", i);
      mesh.erase("primitives");
      drop_extensions(mesh);
      kept_->meshes.push_back(std::move(mesh));
    }
    for (std::size_t n = 0; n < document_.count("nodes"); ++n) {
      GltfJson& node = root()["nodes"][n];
      if (gltf_extension(node, kInstancing) == nullptr) continue;
      for (GltfJson& accessor : node["extensions"][kInstancing]["attributes"]) {
        accessor = kept_accessor(document_.whole_of(accessor, "attribute"));
      }
    }
  }

  // They name nodes, which stay.
  void keep_skins() {
    if (!what_.looks || document_.count("skins") == 0) return;
    root()["skins"] = GltfJson::array();
    for (std::size_t i = 0; i < document_.count("skins"); ++i) {
      GltfJson skin = document_.entry("skins", i);
      try {
        const auto number = document_.whole(skin, "inverseBindMatrices");
        if (number) skin["inverseBindMatrices"] = kept_accessor(*number);
      } catch (const InputError&) {  // matrices that are not there are those of no turn
        skin.erase("inverseBindMatrices");
      }
      root()["skins"].push_back(std::move(skin));
    }
  }

  [[nodiscard]] bool is_dropped(std::string_view extension) const {
    if (extension == kInstancing) return !what_.scene;
    return std::find(kOfMeshes.begin(), kOfMeshes.end(), extension) != kOfMeshes.end();
  }

  void drop_extensions(GltfJson& object) const {
    const auto extensions = object.find("extensions");
    if (extensions == object.end() || !extensions->is_object()) return;
    for (const std::string_view name : kOfMeshes) extensions->erase(name);
    if (is_dropped(kInstancing)) extensions->erase(kInstancing);
    erase_if_empty(object, "extensions");
  }

  void keep_images() {
    for (std::size_t i = 0; i < document_.count("images"); ++i) {
      GltfJson& image = root()["images"][i];
      const auto view = document_.whole(image, "bufferView");
      if (view) {
        image["bufferView"] = kept_view(*view, attributes_.images[i].bytes);
      } else if (attributes_.images[i].bytes && !is_data_uri(gltf_text(image, "uri"))) {
        take_in(image, attributes_.images[i]);
      }
    }
  }

  // A file of the archive that the document came out of: others have no such file beside them.
  void take_in(GltfJson& json, const Image& image) {
    json.erase("uri");
    json["bufferView"] = views_.size();
    json["mimeType"] = media_type_of(image);
    if (gltf_text(json, "name").empty()) json["name"] = image.name;
    views_.push_back(GltfJson::object());
    kept_->views.push_back(image.bytes);
  }

  std::size_t kept_view(std::size_t number, std::shared_ptr<const std::string> bytes) {
    const auto [found, is_new] = view_numbers_.try_emplace(number, views_.size());
    if (!is_new) return found->second;
    GltfJson view = document_.entry("bufferViews", number);
    for (const char* key : {"buffer", "byteOffset"}) view.erase(key);
    drop_extensions(view);
    views_.push_back(std::move(view));
    kept_->views.push_back(bytes ? std::move(bytes)
                                 : std::make_shared<const std::string>(buffers_.view(number)));
    return found->second;
  }

  void keep_animations() {
    if (document_.count("animations") == 0) return;
    GltfJson kept = GltfJson::array();
    for (GltfJson& animation : root()["animations"]) {
      try {
        if (keep_animation(animation)) kept.push_back(std::move(animation));
      } catch (const InputError&) {  // a broken one moves nothing
      }
    }
    root()["animations"] = std::move(kept);
    erase_if_empty(root(), "animations");
  }

  // False if nothing is left of it.
  bool keep_animation(GltfJson& animation) {
    const GltfJson* const channels = gltf_member(animation, "channels");
    const GltfJson* const samplers = gltf_member(animation, "samplers");
    if (channels == nullptr || samplers == nullptr || !samplers->is_array()) return false;
    GltfJson kept = GltfJson::array();
    for (const GltfJson& channel : *channels) {
      const GltfJson* const target = gltf_member(channel, "target");
      if (target == nullptr) continue;
      if (moves_what_goes(*target)) {
        ++kept_->still_channels;
      } else {
        kept.push_back(channel);
      }
    }
    if (kept.empty()) return false;
    for (GltfJson& sampler : animation["samplers"]) {
      for (const char* key : {"input", "output"}) {
        const std::size_t number = document_.required_whole(sampler, key);
        sampler[key] = kept_accessor(number);
      }
    }
    animation["channels"] = std::move(kept);
    return true;
  }

  [[nodiscard]] bool moves_what_goes(const GltfJson& target) const {
    const bool has_targets = what_.scene && what_.looks;
    if (gltf_text(target, "path") == "weights") return !has_targets;
    const GltfJson* const pointer = gltf_extension(target, "KHR_animation_pointer");
    if (pointer == nullptr) return false;
    const std::string path = gltf_text(*pointer, "pointer");
    return path.starts_with("/meshes") || path.starts_with("/skins") ||
           (!has_targets && path.find("/weights") != std::string::npos) ||
           (!what_.looks && path.starts_with("/materials"));
  }

  std::size_t kept_accessor(std::size_t number) {
    const auto known = accessor_numbers_.find(number);
    if (known != accessor_numbers_.end()) return known->second;
    GltfJson accessor = document_.entry("accessors", number);
    keep_view_of(accessor);
    if (gltf_member(accessor, "sparse") != nullptr) {
      for (const char* part : {"indices", "values"}) {
        if (gltf_member(accessor["sparse"], part) != nullptr)
          keep_view_of(accessor["sparse"][part]);
      }
    }
    accessors_.push_back(std::move(accessor));
    accessor_numbers_.emplace(number, accessors_.size() - 1);
    return accessors_.size() - 1;
  }

  void keep_view_of(GltfJson& object) {
    const auto view = document_.whole(object, "bufferView");
    if (view) object["bufferView"] = kept_view(*view, nullptr);
  }

  void keep_extensions() {
    drop_extensions(root());
    for (const char* key : {"extensionsUsed", "extensionsRequired"}) {
      const auto names = root().find(key);
      if (names == root().end()) continue;
      GltfJson kept = GltfJson::array();
      for (const GltfJson& name : *names) {
        const bool goes = name.is_string() && is_dropped(name.get_ref<const std::string&>());
        if (!goes) kept.push_back(name);
      }
      *names = std::move(kept);
      erase_if_empty(root(), key);
    }
  }

  const GltfDocument& document_;
  GltfBuffers& buffers_;
  const Attributes& attributes_;
  GltfKept what_;
  std::shared_ptr<GltfKeepsake> kept_;
  GltfJson accessors_ = GltfJson::array(), views_ = GltfJson::array();
  std::unordered_map<std::size_t, std::size_t> accessor_numbers_, view_numbers_;
};

}  // namespace

GltfSmallV::Key GltfSmallV::key_of(std::size_t set, double u, double flipped) {
  return {set, std::bit_cast<std::uint64_t>(u), std::bit_cast<std::uint64_t>(flipped)};
}

void GltfSmallV::add(std::size_t set, double u, double flipped, float v) {
  if (static_cast<float>(1 - flipped) != v) small_.emplace(key_of(set, u, flipped), v);
}

float GltfSmallV::original(std::size_t set, double u, double flipped) const {
  const auto found = small_.empty() ? small_.end() : small_.find(key_of(set, u, flipped));
  return found == small_.end() ? static_cast<float>(1 - flipped) : found->second;
}

std::shared_ptr<const Keepsake> GltfKeepsake::appended_to(const Keepsake* first,
                                                          AppendedMaterials& names) const {
  if (first == nullptr) return renamed(names);
  const auto* const before = dynamic_cast<const GltfKeepsake*>(first);
  if (before == nullptr) return nullptr;
  std::shared_ptr<GltfKeepsake> both = before->copy();
  GltfLooks own = *this;
  renumber_texture_sets(own, names.texture_sets);
  const std::vector<std::size_t> numbers = append_looks(*both, own);
  both->variants.erase({0, kNone});  // triangles of this one may have no material, too
  for (std::size_t m = 0; m < materials.size() && m < numbers.size(); ++m) {
    if (numbers[m] >= both->materials.size()) {
      both->materials.push_back(names.free_name(materials[m]));
    }
    names.new_names[materials[m]] = both->materials[numbers[m]];
  }
  both->small_v.append(small_v);
  return both;
}

std::shared_ptr<const Keepsake> GltfKeepsake::renamed(AppendedMaterials& names) const {
  std::shared_ptr<GltfKeepsake> result = copy();
  renumber_texture_sets(*result, names.texture_sets);
  for (std::string& name : result->materials) {
    const std::string& given = names.new_names[name] = names.free_name(name);
    name = given;
  }
  return result;
}

std::shared_ptr<GltfKeepsake> GltfKeepsake::copy() const {
  auto result = std::make_shared<GltfKeepsake>();
  static_cast<GltfLooks&>(*result) = *this;
  result->has_scene = has_scene;
  result->meshes = meshes;
  result->objects = objects;
  result->materials = materials;
  result->small_v = small_v;
  return result;
}

std::shared_ptr<GltfKeepsake> make_gltf_keepsake(const GltfDocument& document, GltfBuffers& buffers,
                                                 const Attributes& attributes, GltfKept kept) {
  return KeepsakeMaker(document, buffers, attributes, kept).run();
}

std::vector<std::string> GltfKeepsake::lost_in(SoupFormat format) const {
  std::vector<std::string> lost;
  if (format == SoupFormat::glb || format == SoupFormat::gltf) return lost;
  const auto materials_of_root = root.find("materials");
  const bool has_more =
      materials_of_root != root.end() &&
      std::any_of(materials_of_root->begin(), materials_of_root->end(), says_more_than_looks);
  if (has_more) lost.emplace_back("what else materials say");
  for (const char* key : {"cameras", "animations"}) {
    if (root.contains(key)) lost.emplace_back(key);
  }
  const GltfJson* const nodes = has_scene ? gltf_member(root, "nodes") : nullptr;
  if (nodes != nullptr && std::any_of(nodes->begin(), nodes->end(), is_gltf_hidden)) {
    lost.emplace_back("that nodes are hidden");
  }
  if (gltf_extension(root, "KHR_lights_punctual") != nullptr) lost.emplace_back("lights");
  return lost;
}

}  // namespace meshrepair
