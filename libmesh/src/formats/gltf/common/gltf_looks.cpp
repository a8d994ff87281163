// SPDX-License-Identifier: MIT
#include "gltf_looks.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>

namespace meshrepair {
namespace {

using Numbers = std::vector<std::size_t>;

std::size_t size_of_list(const GltfJson& root, const char* name) {
  const GltfJson* const list = gltf_member(root, name);
  return list != nullptr && list->is_array() ? list->size() : 0;
}

bool has_variants(const GltfLooks& looks, std::size_t material) {
  return std::any_of(looks.variants.begin(), looks.variants.end(),
                     [&](const auto& one) { return one.first.second == material; });
}

// Lists of a document, and what is in them already.
class KnownEntries {
 public:
  KnownEntries(const GltfLooks& looks, const char* list)
      : is_images_(std::string(list) == "images") {
    const bool are_materials = std::string(list) == "materials";
    for (std::size_t i = 0; i < size_of_list(looks.root, list); ++i) {
      if (are_materials && has_variants(looks, i)) continue;
      numbers_.try_emplace(key_of(looks.root[list][i], looks, i), i);
    }
  }

  // `entry` is entry i of `looks`, as it will be written.
  std::size_t number_of(const GltfJson& entry, const GltfLooks& looks, std::size_t i,
                        std::size_t fresh) {
    return numbers_.try_emplace(key_of(entry, looks, i), fresh).first->second;
  }

 private:
  // Its text; of an image also its bytes and where its file is.
  [[nodiscard]] std::string key_of(const GltfJson& entry, const GltfLooks& looks,
                                   std::size_t i) const {
    if (!is_images_) return entry.dump();
    GltfJson text = entry;
    if (text.is_object()) text.erase("bufferView");
    std::string key = text.dump();
    if (i >= looks.images.size()) return key;
    key += '\n' + looks.images[i].path + '\n';
    if (looks.images[i].bytes) key += *looks.images[i].bytes;
    return key;
  }

  bool is_images_;
  std::unordered_map<std::string, std::size_t> numbers_;
};

class LooksAppender {
 public:
  LooksAppender(GltfLooks& all, const GltfLooks& other) : all_(all), other_(other) {}

  Numbers run() {
    images_ = append("images", [](GltfJson& /*image*/) {});
    samplers_ = append("samplers", [](GltfJson& /*sampler*/) {});
    textures_ = append("textures", [&](GltfJson& texture) { renumber_texture(texture); });
    const std::size_t before = size_of_list(all_.root, "materials");
    Numbers materials = append("materials", [&](GltfJson& material) { renumber_uses(material); });
    renumber_levels(before, materials);
    add_extensions();
    return materials;
  }

 private:
  Numbers append(const char* name, const std::function<void(GltfJson&)>& renumber) {
    Numbers numbers;
    const std::size_t count = size_of_list(other_.root, name);
    if (count == 0) return numbers;
    const bool is_materials = name == std::string("materials");
    KnownEntries known(all_, name);
    for (std::size_t i = 0; i < count; ++i) {
      GltfJson entry = other_.root[name][i];
      renumber(entry);
      const std::size_t fresh = size_of_list(all_.root, name);
      // Numbers of materials in it do not tell what it is.
      const bool is_own =
          gltf_extension(entry, "MSFT_lod") != nullptr || (is_materials && has_variants(other_, i));
      numbers.push_back(is_own ? fresh : known.number_of(entry, other_, i, fresh));
      if (numbers.back() != fresh) continue;
      collect_extensions(entry);
      if (name == std::string("images")) take_image(entry, i);
      GltfJson& list = all_.root[name];
      if (!list.is_array()) list = GltfJson::array();
      list.push_back(std::move(entry));
    }
    return numbers;
  }

  void take_image(GltfJson& image, std::size_t i) {
    all_.images.push_back(i < other_.images.size() ? other_.images[i] : Image());
    const auto view = number_in(image, "bufferView");
    if (!view) return;
    const std::size_t fresh = all_.views.size();
    const auto [found, is_new] = views_.try_emplace(*view, fresh);
    if (is_new) {
      all_.root["bufferViews"].push_back(other_.root["bufferViews"][*view]);
      all_.views.push_back(other_.views[*view]);
    }
    image["bufferView"] = found->second;
  }

  // Newer kinds of images stand in extensions.
  void renumber_texture(GltfJson& texture) const {
    renumber(texture, "source", images_);
    renumber(texture, "sampler", samplers_);
    if (gltf_member(texture, "extensions") == nullptr) return;
    for (GltfJson& extension : texture["extensions"]) {
      renumber(extension, "source", images_);
      renumber(extension, "sampler", samplers_);
    }
  }

  // See needed_textures().
  void renumber_uses(GltfJson& material) const {
    if (!material.is_structured()) return;
    for (auto item = material.begin(); item != material.end(); ++item) {
      const std::string key = material.is_object() ? item.key() : std::string();
      if (key == "extras") continue;
      renumber_uses(*item);
      if (key.ends_with("Texture")) renumber(*item, "index", textures_);
    }
  }

  // A number of nothing stays one.
  static void renumber(GltfJson& object, const char* key, const Numbers& numbers) {
    const auto number = number_in(object, key);
    if (!number) return;
    if (*number < numbers.size()) {
      object[key] = numbers[*number];
    } else {
      object.erase(key);
    }
  }

  static std::optional<std::size_t> number_in(const GltfJson& object, const char* key) {
    const GltfJson* const value = gltf_member(object, key);
    if (value == nullptr || !value->is_number()) return std::nullopt;
    constexpr std::uint32_t kMost = std::numeric_limits<std::uint32_t>::max();  // no list has more
    if (value->is_number_unsigned()) return std::min<std::size_t>(gltf_whole(*value), kMost);
    const double number = value->get<double>();
    return number >= 0 && number < kMost ? static_cast<std::size_t>(number) : std::size_t{kMost};
  }

  // Of materials that stand for one from farther away.
  void renumber_levels(std::size_t before, const Numbers& materials) {
    for (std::size_t m = before; m < size_of_list(all_.root, "materials"); ++m) {
      GltfJson& material = all_.root["materials"][m];
      const GltfJson* const levels = gltf_extension(material, "MSFT_lod");
      const GltfJson* const ids = levels == nullptr ? nullptr : gltf_member(*levels, "ids");
      if (ids == nullptr || !ids->is_array()) continue;
      GltfJson renumbered = GltfJson::array();
      for (const GltfJson& id : *ids) {
        const bool is_there = id.is_number_unsigned() && gltf_whole(id) < materials.size();
        if (is_there) renumbered.push_back(materials[gltf_whole(id)]);
      }
      material["extensions"]["MSFT_lod"]["ids"] = std::move(renumbered);
    }
  }

  void collect_extensions(const GltfJson& json) {
    if (!json.is_structured()) return;
    for (const auto& [key, value] : json.items()) {
      if (json.is_object() && key == "extras") continue;
      if (json.is_object() && key == "extensions" && value.is_object()) {
        for (const auto& [name, extension] : value.items()) extensions_.insert(name);
      }
      collect_extensions(value);
    }
  }

  // Those that came along.
  void add_extensions() {
    for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
      const GltfJson* const names = gltf_member(other_.root, list);
      if (names == nullptr || !names->is_array()) continue;
      for (const GltfJson& name : *names) {
        const bool came = name.is_string() && extensions_.contains(name.get<std::string>());
        if (!came) continue;
        GltfJson& own = all_.root[list];
        if (!own.is_array()) own = GltfJson::array();
        if (std::find(own.begin(), own.end(), name) == own.end()) own.push_back(name);
      }
    }
  }

  GltfLooks& all_;
  const GltfLooks& other_;
  Numbers images_, samplers_, textures_;
  std::unordered_map<std::size_t, std::size_t> views_;
  std::set<std::string> extensions_;
};

using TextureSets = std::vector<std::uint32_t>;

void renumber_set(GltfJson& use, const TextureSets& numbers) {
  const GltfJson* const given = gltf_member(use, "texCoord");
  const std::size_t set = given != nullptr && given->is_number_unsigned() ? gltf_whole(*given) : 0;
  if (set < numbers.size() && numbers[set] != set) use["texCoord"] = numbers[set];
}

// See needed_textures().
void renumber_sets(GltfJson& material, const TextureSets& numbers) {
  if (!material.is_structured()) return;
  for (auto item = material.begin(); item != material.end(); ++item) {
    const std::string key = material.is_object() ? item.key() : std::string();
    if (key == "extras") continue;
    renumber_sets(*item, numbers);
    if (!key.ends_with("Texture") || gltf_member(*item, "index") == nullptr) continue;
    renumber_set(*item, numbers);
    const GltfJson* const transform = gltf_extension(*item, "KHR_texture_transform");
    if (transform != nullptr && gltf_member(*transform, "texCoord") != nullptr) {
      renumber_set((*item)["extensions"]["KHR_texture_transform"], numbers);
    }
  }
}

}  // namespace

void renumber_texture_sets(GltfLooks& looks, const TextureSets& numbers) {
  bool are_same = true;
  for (std::size_t i = 0; i < numbers.size(); ++i) are_same = are_same && numbers[i] == i;
  if (are_same || size_of_list(looks.root, "materials") == 0) return;
  for (GltfJson& material : looks.root["materials"]) renumber_sets(material, numbers);
}

std::vector<std::size_t> append_looks(GltfLooks& all, const GltfLooks& other) {
  return LooksAppender(all, other).run();
}

}  // namespace meshrepair
