// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include <mesh/named_files.h>

#include "formats/common/regions.h"
#include "formats/common/uri.h"
#include "formats/gltf/common/srgb.h"
#include "gltf_builder.h"
#include "gltf_io.h"
#include "gltf_keepsake.h"
#include "gltf_materials.h"
#include "gltf_movement.h"
#include "gltf_vertices.h"

namespace meshrepair {
namespace {

namespace fs = std::filesystem;

const char* type_of(std::size_t components) {
  constexpr std::array<const char*, 5> kTypes = {"SCALAR", "SCALAR", "VEC2", "VEC3", "VEC4"};
  if (components < kTypes.size()) return kTypes[components];
  return components == 9 ? "MAT3" : "MAT4";
}

class GltfWriter {
 public:
  GltfWriter(const TriangleSoup& soup, const SoupExtras& extras)
      : soup_(soup),
        extras_(extras),
        attributes_(extras.attributes),
        kept_(attributes_ == nullptr
                  ? nullptr
                  : dynamic_cast<const GltfKeepsake*>(attributes_->keepsake.get())),
        scale_(extras.unit ? unit_scale(*extras.unit, LengthUnit::meter) : 1),
        builder_(kept_) {}

  std::string run(bool binary) {
    add_comments();
    move_image_names();
    if (extras_.scene != nullptr) {
      add_scene(*extras_.scene);
    } else if (!soup_.triangles.empty()) {
      add_objects();
    }
    settle_gltf_movement(builder_);
    return builder_.finish(binary);
  }

 private:
  struct WrittenTexture {
    std::uint32_t image;
    TextureSampling sampling;
    std::size_t source, number;  // in their lists
  };

  void add_comments() {
    if (extras_.comments.empty()) return;
    GltfJson& extras = builder_.root()["asset"]["extras"];
    if (extras.is_null()) extras = GltfJson::object();
    if (extras.is_object()) extras["comments"] = extras_.comments;
  }

  // A node with a mesh for each; without any, for all.
  void add_objects() {
    if (attributes_ == nullptr || attributes_->objects.empty()) {
      return add_object({}, numbers_between(0, soup_.triangles.size()));
    }
    const TriangleLabels& objects = attributes_->objects;
    const SortedRegions sorted = sort_by_region(objects);
    for (std::size_t i = 0; i + 1 < sorted.first.size(); ++i) {
      if (sorted.first[i] == sorted.first[i + 1]) continue;
      add_object(
          i < objects.names.size() ? objects.names[i] : std::string(),
          std::span(sorted.order).subspan(sorted.first[i], sorted.first[i + 1] - sorted.first[i]));
    }
  }

  void add_object(const std::string& name, std::span<const std::uint32_t> triangles) {
    GltfJson json = GltfJson::object();
    GltfObject kept;
    if (kept_ != nullptr && kept_->objects.contains(name)) kept = kept_->objects.at(name);
    if (!kept.mesh.is_null()) json = std::move(kept.mesh);
    if (!name.empty()) json["name"] = name;
    GltfJson node = {{"mesh", add_mesh(0, triangles, std::move(json))}, {"name", name}};
    if (kept.skin) node["skin"] = *kept.skin;
    if (scale_ != 1) node["scale"] = {scale_, scale_, scale_};
    if (extras_.origin) {
      const Vec3d origin = scale_ * *extras_.origin;
      node["translation"] = {origin.x(), origin.y(), origin.z()};
    }
    add_gltf_node(builder_, std::move(node));
  }

  static std::vector<std::uint32_t> numbers_between(std::size_t first, std::size_t end) {
    std::vector<std::uint32_t> numbers(end - first);
    std::iota(numbers.begin(), numbers.end(), static_cast<std::uint32_t>(first));
    return numbers;
  }

  // Nodes name meshes by their numbers; meshes without triangles are left out.
  void add_scene(const Scene& scene) {
    const bool is_kept = kept_ != nullptr && kept_->has_scene;
    std::vector<std::size_t> numbers;
    std::size_t first = 0;
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
      const SceneMesh& mesh = scene.meshes[m];
      GltfJson json = is_kept && m < kept_->meshes.size() ? kept_->meshes[m] : GltfJson::object();
      if (!is_kept && !mesh.name.empty()) json["name"] = mesh.name;
      numbers.push_back(
          mesh.triangles == 0
              ? kNoGltfMesh
              : add_mesh(m, numbers_between(first, first + mesh.triangles), std::move(json)));
      first += mesh.triangles;
    }
    if (is_kept) {
      renumber_gltf_meshes(builder_, numbers);
    } else {
      add_gltf_instances(builder_, scene, numbers, scale_);
    }
  }

  // Of the file that was read: they were relative to its folder.
  void move_image_names() {
    if (kept_ == nullptr) return;
    const auto images = builder_.root().find("images");
    if (images == builder_.root().end()) return;
    const std::size_t count = std::min(images->size(), kept_->images.size());
    for (std::size_t i = 0; i < count; ++i) {
      const Image& image = kept_->images[i];
      if (image.path.empty()) continue;
      GltfJson& uri = (*images)[i]["uri"];
      const std::string moved = relative_name(image);
      if (!uri.is_string() ||
          fs::path(decode_percent(uri.get<std::string>())).lexically_normal() != moved) {
        uri = encode_percent(moved);
      }
    }
  }

  // Of a file that is elsewhere.
  static std::string name_as_uri(const std::string& name) {
    return name.find("://") == std::string::npos ? encode_percent(name) : name;
  }

  [[nodiscard]] std::string relative_name(const Image& image) const {
    return name_seen_from(extras_.folder, image.path);
  }

  // Of these triangles; `mesh` is what else it has, `number` that of the scene.
  std::size_t add_mesh(std::size_t number, std::span<const std::uint32_t> all, GltfJson mesh) {
    GltfJson primitives = GltfJson::array();
    for (const auto& [label, triangles] : triangles_by_material(all)) {
      const std::size_t material = label == kNone ? kNone : material_of(label);
      const GltfJson* const variants = variants_of(number, material);
      std::size_t textures = textures_of(material);
      if (variants != nullptr) textures = std::max(textures, textures_of_variants(*variants));
      primitives.push_back(make_primitive(triangles, {textures, all}));
      if (material != kNone) primitives.back()["material"] = material;
      if (variants != nullptr) primitives.back()["extensions"][kGltfVariants] = *variants;
    }
    mesh["primitives"] = std::move(primitives);
    return builder_.append("meshes", std::move(mesh));
  }

  [[nodiscard]] std::size_t textures_of(std::size_t material) {
    const GltfJson* const materials = gltf_member(builder_.root(), "materials");
    const bool is_there = materials != nullptr && material < materials->size();
    return is_there ? needed_textures((*materials)[material]) : 0;
  }

  [[nodiscard]] std::size_t textures_of_variants(const GltfJson& variants) {
    std::size_t textures = 0;
    const GltfJson* const mappings = gltf_member(variants, "mappings");
    if (mappings == nullptr) return textures;
    for (const GltfJson& mapping : *mappings) {
      const GltfJson* const material = gltf_member(mapping, "material");
      if (material == nullptr || !material->is_number_unsigned()) continue;
      textures = std::max(textures, textures_of(gltf_whole(*material)));
    }
    return textures;
  }

  [[nodiscard]] const GltfJson* variants_of(std::size_t mesh, std::size_t material) const {
    if (kept_ == nullptr) return nullptr;
    const auto found = kept_->variants.find({mesh, material});
    return found == kept_->variants.end() ? nullptr : &found->second;
  }

  // In the order of the labels, those without at the end.
  [[nodiscard]] std::map<std::uint32_t, std::vector<std::uint32_t>> triangles_by_material(
      std::span<const std::uint32_t> all) const {
    std::map<std::uint32_t, std::vector<std::uint32_t>> lists;
    const bool has_labels = attributes_ != nullptr && !attributes_->materials.empty();
    for (const std::uint32_t t : all) {
      lists[has_labels ? attributes_->materials.of_triangle[t] : kNone].push_back(t);
    }
    return lists;
  }

  GltfJson make_primitive(const std::vector<std::uint32_t>& triangles, const GltfNeeds& needs) {
    const GltfVertices vertices = make_vertices(soup_, triangles, attributes_, kept_, needs);
    GltfJson primitive = {{"attributes", GltfJson::object()}, {"mode", 4}};
    for (const GltfColumn& column : vertices.columns) {
      const std::size_t accessor = add_column(column, vertices.count);
      add_gltf_values(builder_, column.name, accessor, vertices.count, primitive);
    }
    primitive["indices"] = add_indices(vertices);
    return primitive;
  }

  std::size_t add_column(const GltfColumn& column, std::size_t count) {
    const std::size_t view =
        builder_.append_view(column.bytes, GltfBuilder::Target::vertices, column.stride);
    GltfJson accessor = {{"bufferView", view},
                         {"componentType", static_cast<std::uint32_t>(column.layout.component)},
                         {"count", count},
                         {"type", type_of(column.layout.components)}};
    if (column.layout.normalized) accessor["normalized"] = true;
    if (column.name.ends_with("POSITION")) add_bounds(column, accessor);
    return builder_.append("accessors", std::move(accessor));
  }

  static void add_bounds(const GltfColumn& column, GltfJson& accessor) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    std::array<float, 3> low, high;
    low.fill(kInfinity);
    high.fill(-kInfinity);
    for (std::size_t at = 0; at + sizeof low <= column.bytes.size(); at += column.stride) {
      std::array<float, 3> point;
      std::memcpy(point.data(), column.bytes.data() + at, sizeof point);
      for (std::size_t i = 0; i < 3; ++i) {
        if (!std::isfinite(point[i])) continue;
        low[i] = std::min(low[i], point[i]);
        high[i] = std::max(high[i], point[i]);
      }
    }
    for (std::size_t i = 0; i < 3; ++i) {
      if (low[i] > high[i]) low[i] = high[i] = 0;
    }
    accessor["min"] = low;
    accessor["max"] = high;
  }

  std::size_t add_indices(const GltfVertices& vertices) {
    // The largest number of each width is none.
    const bool is_short = vertices.count < std::numeric_limits<std::uint16_t>::max();
    std::string bytes;
    bytes.reserve(vertices.corners.size() * (is_short ? 2 : 4));
    for (const std::uint32_t corner : vertices.corners) {
      bytes.append(reinterpret_cast<const char*>(&corner), is_short ? 2 : 4);
    }
    const std::size_t view = builder_.append_view(bytes, GltfBuilder::Target::indices);
    const auto component = is_short ? GltfComponent::uint16 : GltfComponent::uint32;
    return builder_.append("accessors", {{"bufferView", view},
                                         {"componentType", static_cast<std::uint32_t>(component)},
                                         {"count", vertices.corners.size()},
                                         {"type", "SCALAR"}});
  }

  // Meshes share it.
  std::size_t material_of(std::uint32_t label) {
    const auto [found, is_new] = material_numbers_.try_emplace(label, 0);
    if (is_new) found->second = add_material(label);
    return found->second;
  }

  std::size_t add_material(std::uint32_t label) {
    const std::string& name = attributes_->materials.names[label];
    if (kept_ != nullptr) {
      const auto known = std::find(kept_->materials.begin(), kept_->materials.end(), name);
      if (known != kept_->materials.end()) {
        return static_cast<std::size_t>(known - kept_->materials.begin());
      }
    }
    GltfJson material = {{"name", name}};
    if (label < attributes_->looks.size()) add_look(attributes_->looks[label], material);
    return builder_.append("materials", std::move(material));
  }

  void add_look(const Material& look, GltfJson& material) {
    std::array<double, 4> colour = look.colour;
    for (double& part : colour) part = std::isfinite(part) ? std::clamp(part, 0.0, 1.0) : 1.0;
    GltfJson shading = {{"metallicFactor", 0.0}};
    for (std::size_t i = 0; i < 3; ++i) colour[i] = linear_of_srgb(colour[i]);
    if (colour != Material().colour) shading["baseColorFactor"] = colour;
    if (look.image < attributes_->images.size()) {
      shading["baseColorTexture"] = placed_texture(look);
    }
    material["pbrMetallicRoughness"] = std::move(shading);
    if (colour[3] < 1) material["alphaMode"] = "BLEND";
    if (look.two_sided) material["doubleSided"] = true;
  }

  GltfJson placed_texture(const Material& look) {
    GltfJson texture = {{"index", texture_of(look.image, look.sampling)}};
    if (look.texture_set != 0) texture["texCoord"] = look.texture_set;
    if (look.transform == TextureTransform()) return texture;
    const auto& [offset, scale, rotation] = look.transform;
    texture["extensions"]["KHR_texture_transform"] = {
        {"offset", offset}, {"scale", scale}, {"rotation", rotation}};
    builder_.use_extension("KHR_texture_transform");
    return texture;
  }

  std::size_t texture_of(std::uint32_t image, const TextureSampling& sampling) {
    const auto known = std::find_if(
        textures_.begin(), textures_.end(),
        [&](const WrittenTexture& one) { return one.image == image && one.sampling == sampling; });
    if (known != textures_.end()) return known->number;
    const auto same = std::find_if(textures_.begin(), textures_.end(),
                                   [&](const WrittenTexture& one) { return one.image == image; });
    const std::size_t source = same == textures_.end() ? image_of(image) : same->source;
    GltfJson texture = {{"source", source}};
    if (sampling != TextureSampling()) texture["sampler"] = sampler_of(sampling);
    const std::size_t number = builder_.append("textures", std::move(texture));
    textures_.push_back({image, sampling, source, number});
    return number;
  }

  // What ends at its edges has no word here: it goes on as it is there.
  std::size_t sampler_of(const TextureSampling& sampling) {
    const auto known = std::find_if(samplers_.begin(), samplers_.end(),
                                    [&](const auto& one) { return one.first == sampling; });
    if (known != samplers_.end()) return known->second;
    using Wrap = TextureSampling::Wrap;
    const auto wrap = [](Wrap one) {
      if (one == Wrap::repeat) return kGltfRepeat;
      return one == Wrap::mirror ? kGltfMirror : kGltfClamp;
    };
    GltfJson json = {{"wrapS", wrap(sampling.wrap[0])}, {"wrapT", wrap(sampling.wrap[1])}};
    if (sampling.filter != TextureSampling::Filter::automatic) {
      const bool is_linear = sampling.filter == TextureSampling::Filter::linear;
      json["magFilter"] = json["minFilter"] = is_linear ? kGltfLinear : kGltfNearest;
    }
    samplers_.emplace_back(sampling, builder_.append("samplers", std::move(json)));
    return samplers_.back().second;
  }

  std::size_t image_of(std::uint32_t number) {
    const Image& image = attributes_->images[number];
    if (const auto known = kept_image(image)) return *known;
    GltfJson json = GltfJson::object();
    if (!image.name.empty()) json["name"] = image.name;
    if (image.bytes) {
      json["mimeType"] = media_type_of(image);
      json["bufferView"] = builder_.append_view(*image.bytes, GltfBuilder::Target::none);
    } else {
      json["uri"] =
          image.path.empty() ? name_as_uri(image.name) : encode_percent(relative_name(image));
    }
    return builder_.append("images", std::move(json));
  }

  [[nodiscard]] std::optional<std::size_t> kept_image(const Image& image) const {
    if (kept_ == nullptr) return std::nullopt;
    const auto found =
        std::find_if(kept_->images.begin(), kept_->images.end(), [&](const Image& kept) {
          return image.bytes ? kept.bytes == image.bytes
                             : !image.path.empty() && kept.path == image.path;
        });
    if (found == kept_->images.end()) return std::nullopt;
    return static_cast<std::size_t>(found - kept_->images.begin());
  }

  const TriangleSoup& soup_;
  const SoupExtras& extras_;
  const Attributes* attributes_;
  const GltfKeepsake* kept_;
  double scale_;  // of the soup, to be in meters
  GltfBuilder builder_;
  std::map<std::uint32_t, std::size_t> material_numbers_;  // by labels
  std::vector<WrittenTexture> textures_;
  std::vector<std::pair<TextureSampling, std::size_t>> samplers_;
};

}  // namespace

std::string format_gltf(const TriangleSoup& soup, const SoupExtras& extras, bool binary) {
  return GltfWriter(soup, extras).run(binary);
}

}  // namespace meshrepair
