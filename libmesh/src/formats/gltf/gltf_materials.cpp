// SPDX-License-Identifier: MIT
#include "gltf_materials.h"

#include <algorithm>
#include <optional>
#include <string>
#include <unordered_set>
#include <utility>

#include <mesh/named_files.h>

#include "formats/common/uri.h"
#include "formats/gltf/common/srgb.h"

namespace meshrepair {
namespace {

// Of a texture of a material: its extension may say another than it does.
std::size_t texture_set_of(const GltfJson& texture) {
  const GltfJson* const transform = gltf_extension(texture, "KHR_texture_transform");
  const GltfJson* set = gltf_member(texture, "texCoord");
  if (transform != nullptr && gltf_member(*transform, "texCoord") != nullptr) {
    set = gltf_member(*transform, "texCoord");
  }
  constexpr std::size_t kMost = 8;  // no more than any program has
  const bool is_number = set != nullptr && set->is_number_unsigned();
  return is_number ? std::min(gltf_whole(*set), kMost - 1) : 0;
}

// Those that have none, or that of one before, get one.
std::vector<std::string> unique_names(const GltfDocument& document) {
  std::vector<std::string> names;
  std::unordered_set<std::string> taken;
  for (std::size_t m = 0; m < document.count("materials"); ++m) {
    const std::string own = gltf_text(document.entry("materials", m), "name");
    const std::string number = std::to_string(m);
    std::string name = own.empty() ? "material_" + number : own;
    while (!taken.insert(name).second) name += "_" + number;
    names.push_back(std::move(name));
  }
  return names;
}

// Newer kinds of images stand in extensions.
std::optional<std::size_t> image_of_texture(const GltfDocument& document, const GltfJson& texture) {
  if (const auto source = document.whole(texture, "source")) return source;
  const GltfJson* const extensions = gltf_member(texture, "extensions");
  if (extensions == nullptr || !extensions->is_object()) return std::nullopt;
  for (const GltfJson& extension : *extensions) {
    if (const auto source = document.whole(extension, "source")) return source;
  }
  return std::nullopt;
}

// The member, if it is a list of numbers as long as `values`.
void take_numbers(const GltfJson& object, const char* key, std::array<double, 2>& values) {
  const GltfJson* const list = gltf_member(object, key);
  if (list == nullptr || !list->is_array() || list->size() != values.size()) return;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if ((*list)[i].is_number()) values[i] = (*list)[i].get<double>();
  }
}

// Which set of coordinates a texture takes, and how it moves them.
void place_texture(const GltfJson& texture, Material& look) {
  look.texture_set = static_cast<std::uint32_t>(texture_set_of(texture));
  const GltfJson* const transform = gltf_extension(texture, "KHR_texture_transform");
  if (transform == nullptr) return;
  take_numbers(*transform, "offset", look.transform.offset);
  take_numbers(*transform, "scale", look.transform.scale);
  const GltfJson* const rotation = gltf_member(*transform, "rotation");
  if (rotation != nullptr && rotation->is_number()) {
    look.transform.rotation = rotation->get<double>();
  }
}

// kNone: there is none. No file is refused for what its pictures look like.
std::size_t number_in(const GltfJson& object, const char* key) {
  const GltfJson* const number = gltf_member(object, key);
  return number != nullptr && number->is_number_unsigned() ? gltf_whole(*number) : kNone;
}

TextureSampling::Wrap wrap_of(std::size_t number) {
  using Wrap = TextureSampling::Wrap;
  if (number == kGltfClamp) return Wrap::clamp;
  return number == kGltfMirror ? Wrap::mirror : Wrap::repeat;
}

// What is said of pictures that are seen from near counts for all.
TextureSampling sampling_of(const GltfDocument& document, const GltfJson& texture) {
  TextureSampling sampling;
  const std::size_t number = number_in(texture, "sampler");
  if (number >= document.count("samplers")) return sampling;
  const GltfJson& sampler = document.entry("samplers", number);
  sampling.wrap = {wrap_of(number_in(sampler, "wrapS")), wrap_of(number_in(sampler, "wrapT"))};
  using Filter = TextureSampling::Filter;
  const std::size_t filter = number_in(sampler, "magFilter");
  if (filter == kGltfNearest) sampling.filter = Filter::nearest;
  if (filter == kGltfLinear) sampling.filter = Filter::linear;
  return sampling;
}

Material look_of(const GltfDocument& document, const GltfJson& material) {
  Material look;
  const GltfJson* const shading = gltf_member(material, "pbrMetallicRoughness");
  if (shading == nullptr) return look;
  const GltfJson* const factor = gltf_member(*shading, "baseColorFactor");
  if (factor != nullptr && factor->is_array() && factor->size() == look.colour.size()) {
    for (std::size_t i = 0; i < look.colour.size(); ++i) {
      if ((*factor)[i].is_number()) look.colour[i] = (*factor)[i].get<double>();
    }
    for (std::size_t i = 0; i < 3; ++i) look.colour[i] = srgb_of_linear(look.colour[i]);
  }
  const GltfJson* const texture = gltf_member(*shading, "baseColorTexture");
  const auto number = texture == nullptr ? std::nullopt : document.whole(*texture, "index");
  if (!number) return look;
  const GltfJson& entry = document.entry("textures", *number);
  look.sampling = sampling_of(document, entry);
  const auto image = image_of_texture(document, entry);
  if (image && *image < document.count("images")) look.image = static_cast<std::uint32_t>(*image);
  place_texture(*texture, look);
  return look;
}

Image image_of(const GltfDocument& document, GltfBuffers& buffers, const GltfJson& json) {
  Image image{gltf_text(json, "name"), gltf_text(json, "mimeType"), {}, nullptr};
  if (const auto view = document.whole(json, "bufferView")) {
    image.bytes = std::make_shared<const std::string>(buffers.view(*view));
    return image;
  }
  const std::string uri = gltf_text(json, "uri");
  if (!is_data_uri(uri)) {
    Image named = picture_named(document.source(), decode_percent(uri));
    named.media_type = std::move(image.media_type);
    return named;
  }
  std::optional<DataUri> data = decode_data_uri(uri);
  if (!data) document.source().fail("an image is a data URI that is broken");
  if (image.media_type.empty()) image.media_type = std::move(data->media_type);
  image.bytes = std::make_shared<const std::string>(std::move(data->bytes));
  return image;
}

}  // namespace

void read_materials(const GltfDocument& document, GltfBuffers& buffers, Attributes& attributes) {
  attributes.materials.names = unique_names(document);
  for (std::size_t m = 0; m < document.count("materials"); ++m) {
    attributes.looks.push_back(look_of(document, document.entry("materials", m)));
  }
  for (std::size_t i = 0; i < document.count("images"); ++i) {
    attributes.images.push_back(image_of(document, buffers, document.entry("images", i)));
  }
}

std::string media_type_of(const Image& image) {
  if (!image.media_type.empty()) return image.media_type;
  return image.bytes->starts_with("\xFF\xD8") ? "image/jpeg" : "image/png";
}

// All kinds of textures, also those of extensions, are objects with an index, below a name that
// ends so.
std::size_t needed_textures(const GltfJson& material) {
  std::size_t needed = 0;
  if (!material.is_structured()) return needed;
  for (const auto& [key, value] : material.items()) {
    if (key == "extras") continue;
    needed = std::max(needed, needed_textures(value));
    if (!key.ends_with("Texture") || gltf_member(value, "index") == nullptr) continue;
    needed = std::max(needed, texture_set_of(value) + 1);
  }
  return needed;
}

}  // namespace meshrepair
