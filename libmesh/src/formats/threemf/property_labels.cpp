// SPDX-License-Identifier: MIT
#include "property_labels.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <string_view>
#include <unordered_map>
#include <utility>

#include <mesh/triangle_paint.h>

#include "common/model_values.h"

namespace meshrepair {
namespace {

// What one entry of a group gives a corner.
struct CornerProperty {
  std::uint32_t base = kNone;     // number of a material
  std::uint32_t texture = kNone;  // number of a material that is a texture alone
  std::uint32_t point = kNone;    // in it
  std::uint32_t colour = kNone;

  void lay_over(const CornerProperty& other) {
    if (other.base != kNone) base = other.base;
    if (other.texture != kNone) {
      texture = other.texture;
      point = other.point;
    }
    if (other.colour != kNone) colour = other.colour;
  }
};

class PropertyTables {
 public:
  PropertyTables(const std::vector<ModelPart>& parts, const FindPicture& find,
                 Attributes& attributes, PropertyOddities& oddities)
      : parts_(parts), find_(find), attributes_(attributes), oddities_(oddities) {
    points_.kind = CornerAttribute::Kind::texture;
    points_.components = 2;
    colours_.kind = CornerAttribute::Kind::colour;
    colours_.storage = CornerAttribute::Storage::byte;
    colours_.components = 3;
    for (const ModelPart& part : parts_) {
      for (const PropertyGroup& group : part.groups) {
        if (group.kind == PropertyGroup::Kind::colour && group.has_opacity) colours_.components = 4;
      }
    }
    tables_.resize(parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i) fill(i);
  }

  // Null: there is none.
  [[nodiscard]] const CornerProperty* find(std::uint32_t part, std::uint32_t group,
                                           std::uint32_t entry) const {
    const auto table = tables_[part].find(group);
    if (table == tables_[part].end() || entry >= table->second.size()) return nullptr;
    return &table->second[entry];
  }

  // The label of a triangle that has this. A base material under a texture gets its picture; one
  // that is under another, too, becomes a second material there.
  std::uint32_t material_of(const CornerProperty& property) {
    const std::uint32_t base = property.base, texture = property.texture;
    if (texture == kNone || base == texture) return base;
    if (base == kNone) return texture;
    const Material& over = attributes_.looks[texture];
    Material look = attributes_.looks[base];
    if (look.image == kNone || (look.image == over.image && look.sampling == over.sampling)) {
      lay_picture(over, attributes_.looks[base]);
      return base;
    }
    const auto [found, is_new] = textured_.try_emplace(std::uint64_t{base} << 32 | texture, kNone);
    if (is_new) {
      lay_picture(over, look);
      found->second = add_material(attributes_.materials.names[base], look);
    }
    return found->second;
  }

  CornerAttribute& points() { return points_; }
  CornerAttribute& colours() { return colours_; }

 private:
  using Table = std::vector<CornerProperty>;

  static void lay_picture(const Material& from, Material& to) {
    to.image = from.image;
    to.sampling = from.sampling;
  }

  void fill(std::size_t number) {
    const ModelPart& part = parts_[number];
    auto& tables = tables_[number];
    // Textures look for base materials of their name, layers for all others.
    using GroupKind = PropertyGroup::Kind;
    for (const PropertyGroup& group : part.groups) {
      if (group.kind == GroupKind::base) tables.try_emplace(group.id, table_of(part, group));
    }
    for (const PropertyGroup& group : part.groups) {
      if (group.kind == GroupKind::base || group.kind == GroupKind::multi) continue;
      tables.try_emplace(group.id, table_of(part, group));
    }
    for (const PropertyGroup& group : part.groups) {
      if (group.kind != GroupKind::multi) continue;
      tables.try_emplace(group.id, layered_table(static_cast<std::uint32_t>(number), group));
    }
  }

  Table table_of(const ModelPart& part, const PropertyGroup& group) {
    Table table;
    switch (group.kind) {
      case PropertyGroup::Kind::base:
        for (std::size_t i = 0; i < group.names.size(); ++i) {
          table.emplace_back();
          if (group.names[i] == kNoMaterialName) continue;
          table.back().base = add_material(group.names[i], {.colour = group.colours[i]});
        }
        break;
      case PropertyGroup::Kind::colour:
        for (const auto& colour : group.colours) {
          table.emplace_back();
          table.back().colour = static_cast<std::uint32_t>(colours_.count());
          colours_.values.insert(colours_.values.end(), colour.begin(),
                                 colour.begin() + static_cast<std::ptrdiff_t>(colours_.components));
        }
        break;
      case PropertyGroup::Kind::texture: {
        const std::uint32_t texture = texture_of(part, group.texture);
        for (const auto& point : group.points) {
          table.emplace_back();
          table.back().texture = texture;
          table.back().point = static_cast<std::uint32_t>(points_.count());
          points_.values.insert(points_.values.end(), point.begin(), point.end());
        }
        break;
      }
      default:
        break;
    }
    return table;
  }

  [[nodiscard]] Table layered_table(std::uint32_t part, const PropertyGroup& group) const {
    Table table;
    const std::size_t layers = group.layers.size();
    if (layers == 0) return table;
    table.resize(group.layer_entries.size() / layers);
    for (std::size_t i = 0; i < table.size(); ++i) {
      for (std::size_t layer = 0; layer < layers; ++layer) {
        const CornerProperty* const under =
            find(part, group.layers[layer], group.layer_entries[layers * i + layer]);
        if (under != nullptr) table[i].lay_over(*under);
      }
    }
    return table;
  }

  // The material of a texture; groups with one picture share it. It is that base material which has
  // the name of the picture, if there is one: so they are written here.
  std::uint32_t texture_of(const ModelPart& part, std::uint32_t id) {
    const auto texture = std::find_if(part.textures.begin(), part.textures.end(),
                                      [&](const ModelTexture& one) { return one.id == id; });
    std::optional<Image> image;
    if (texture != part.textures.end()) image = find_(part, *texture);
    if (!image) ++oddities_.unreadable;
    Material look;
    std::string key, name = "texture";
    if (image) {
      look.sampling = read_sampling(texture->tile_u, texture->tile_v, texture->filter);
      key = image->path + ' ' + sampling_key(look.sampling);
      name = std::filesystem::path(image->name).stem().string();
    }
    const auto [found, is_new] = pictures_.try_emplace(key, kNone);
    if (!is_new) return found->second;
    if (image) look.image = number_of(std::move(*image));
    const auto base = names_.find(name);
    if (base != names_.end() && attributes_.looks[base->second].image == kNone) {
      lay_picture(look, attributes_.looks[base->second]);
      found->second = base->second;
    } else {
      found->second = add_material(name, look);
    }
    return found->second;
  }

  static std::string sampling_key(const TextureSampling& sampling) {
    std::string key(tile_name(sampling.wrap[0]));
    return key.append(1, ' ')
        .append(tile_name(sampling.wrap[1]))
        .append(1, ' ')
        .append(filter_name(sampling.filter));
  }

  // Several textures may have one picture; only the first of them brings its bytes.
  std::uint32_t number_of(Image image) {
    const auto fresh = static_cast<std::uint32_t>(attributes_.images.size());
    const auto [found, is_new] = images_.try_emplace(std::exchange(image.path, {}), fresh);
    if (is_new) attributes_.images.push_back(std::move(image));
    return found->second;
  }

  std::uint32_t add_material(const std::string& name, const Material& look) {
    const auto number = static_cast<std::uint32_t>(attributes_.materials.names.size());
    const std::string stem = name.empty() ? "material" : name;
    std::string fresh = stem;
    std::size_t& used = used_[stem];
    while (!names_.try_emplace(fresh, number).second) {
      used = std::max<std::size_t>(used, 1) + 1;
      fresh = stem + " " + std::to_string(used);
    }
    attributes_.materials.names.push_back(std::move(fresh));
    attributes_.looks.push_back(look);
    return number;
  }

  const std::vector<ModelPart>& parts_;
  const FindPicture& find_;
  Attributes& attributes_;
  PropertyOddities& oddities_;
  std::vector<std::unordered_map<std::uint32_t, Table>> tables_;  // of each part, by id
  std::unordered_map<std::uint64_t, std::uint32_t> textured_;
  std::unordered_map<std::string, std::uint32_t> pictures_;  // materials of textures
  std::unordered_map<std::string, std::uint32_t> images_;    // by their parts
  std::unordered_map<std::string, std::uint32_t> names_;
  std::unordered_map<std::string, std::size_t> used_;
  CornerAttribute points_, colours_;
};

// Gives each triangle of the soup its properties.
class PropertyLabeler {
 public:
  PropertyLabeler(const std::vector<ModelPart>& parts, const InstanceResult& placed,
                  const FindPicture& find, PropertyOddities& oddities)
      : parts_(parts),
        placed_(placed),
        oddities_(oddities),
        tables_(parts, find, attributes_, oddities) {}

  Attributes run() {
    for (const MeshInstance& instance : placed_.instances) label(instance);
    for (CornerAttribute* const values : {&tables_.points(), &tables_.colours()}) {
      const auto has_one = [](std::uint32_t value) { return value != kNone; };
      if (std::any_of(values->of_corner.begin(), values->of_corner.end(), has_one)) {
        attributes_.corners.push_back(std::move(*values));
      }
    }
    drop_if_unused(attributes_.materials);
    if (attributes_.materials.empty()) attributes_.looks.clear();
    label_objects();
    drop_if_unused(attributes_.objects);
    label_groups();
    drop_if_unused(attributes_.groups);
    end_paints();
    return std::move(attributes_);
  }

 private:
  static void drop_if_unused(TriangleLabels& labels) {
    if (labels.names.empty()) labels = {};
  }

  void label(const MeshInstance& instance) {
    const ModelObject& object = parts_[instance.part].objects[instance.object];
    for (PropertyUse use : object.properties) {
      if (use.paint != kNone) add_paint(instance, use.paint);
      resolve(object, use);
      if (instance.turned) std::swap(use.index[1], use.index[2]);
      const CornerProperty none;
      std::array<const CornerProperty*, 3> corners = {&none, &none, &none};
      bool missing = false;
      for (std::size_t k = 0; k < 3 && use.group != kNone; ++k) {
        const CornerProperty* const found = tables_.find(instance.part, use.group, use.index[k]);
        missing = missing || found == nullptr;
        if (found != nullptr) corners[k] = found;
      }
      if (missing) ++oddities_.missing;
      append(corners);
    }
  }

  // Of the next triangle.
  void add_paint(const MeshInstance& instance, std::uint32_t paint) {
    const std::size_t triangle = attributes_.materials.of_triangle.size();
    const ModelPart& part = parts_[instance.part];
    for (std::size_t k = 0; k < kPaintNames.size(); ++k) {
      const std::uint32_t code = part.painted[paint][k];
      if (code == kNone) continue;
      TriangleLabels& codes = paints_[k].codes;
      const auto fresh = static_cast<std::uint32_t>(codes.names.size());
      const auto [found, is_new] = codes_[k].try_emplace(part.codes[code], fresh);
      if (is_new) codes.names.push_back(part.codes[code]);
      codes.of_triangle.resize(triangle, kNone);
      codes.of_triangle.push_back(found->second);
      if (instance.turned) turned_[k].push_back(triangle);
    }
  }

  void end_paints() {
    for (std::size_t k = 0; k < kPaintNames.size(); ++k) {
      TrianglePaint& paint = paints_[k];
      if (paint.codes.empty()) continue;
      paint.name = kPaintNames[k].written;
      paint.codes.of_triangle.resize(placed_.soup.triangles.size(), kNone);
      turn_paint(paint, turned_[k]);
      attributes_.paints.push_back(std::move(paint));
    }
  }

  // What the object says holds where the triangle says nothing.
  static void resolve(const ModelObject& object, PropertyUse& use) {
    if (use.index[0] == kNone) {
      use = object.property;
      return;
    }
    if (use.group == kNone) use.group = object.property.group;
    for (std::uint32_t& index : use.index) index = index == kNone ? use.index[0] : index;
  }

  void append(const std::array<const CornerProperty*, 3>& corners) {
    for (const CornerProperty* const corner : corners) {
      tables_.points().of_corner.push_back(corner->point);
      tables_.colours().of_corner.push_back(corner->colour);
    }
    const auto same = [&](const CornerProperty* corner) {
      return corner->base == corners[0]->base && corner->texture == corners[0]->texture;
    };
    if (!std::all_of(corners.begin(), corners.end(), same)) ++oddities_.gradients;
    attributes_.materials.of_triangle.push_back(tables_.material_of(*corners[0]));
  }

  void label_objects() {
    std::unordered_map<std::string_view, std::uint32_t> numbers;
    TriangleLabels& objects = attributes_.objects;
    for (std::size_t i = 0; i < placed_.instances.size(); ++i) {
      const MeshInstance& instance = placed_.instances[i];
      std::uint32_t label = kNone;
      if (instance.named != kNone) {
        const std::string& name = parts_[instance.named_part].objects[instance.named].name;
        const auto fresh = static_cast<std::uint32_t>(objects.names.size());
        const auto [found, is_new] = numbers.try_emplace(name, fresh);
        if (is_new) objects.names.push_back(name);
        label = found->second;
      }
      const bool is_last = i + 1 == placed_.instances.size();
      objects.of_triangle.resize(
          is_last ? placed_.soup.triangles.size() : placed_.instances[i + 1].first, label);
    }
  }

  // By the sets of triangles. Copies of an object share its names.
  void label_groups() {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> labels;
    std::unordered_map<std::string_view, std::uint32_t> numbers;
    TriangleLabels& groups = attributes_.groups;
    for (const MeshInstance& instance : placed_.instances) {
      const ModelObject& object = parts_[instance.part].objects[instance.object];
      const auto [known, is_new] = labels.try_emplace({instance.part, instance.object});
      if (is_new) known->second = labels_of_sets(object, numbers);
      groups.of_triangle.resize(instance.first, kNone);
      for (const std::uint32_t set : object.set_of_triangle) {
        groups.of_triangle.push_back(set == kNone ? kNone : known->second[set]);
      }
    }
    groups.of_triangle.resize(placed_.soup.triangles.size(), kNone);
  }

  std::vector<std::uint32_t> labels_of_sets(
      const ModelObject& object, std::unordered_map<std::string_view, std::uint32_t>& numbers) {
    std::vector<std::string>& names = attributes_.groups.names;
    std::vector<std::uint32_t> labels;
    for (const TriangleSet& set : object.sets) {
      const bool has_name = !set.name.empty();
      const auto fresh = static_cast<std::uint32_t>(names.size());
      const auto [found, is_new] = numbers.try_emplace(set.name, has_name ? fresh : kNone);
      if (is_new && has_name) names.push_back(set.name);
      labels.push_back(found->second);
    }
    return labels;
  }

  const std::vector<ModelPart>& parts_;
  const InstanceResult& placed_;
  PropertyOddities& oddities_;
  Attributes attributes_;
  PropertyTables tables_;
  std::array<TrianglePaint, kPaintNames.size()> paints_;
  std::array<std::unordered_map<std::string, std::uint32_t>, kPaintNames.size()> codes_;
  std::array<std::vector<std::size_t>, kPaintNames.size()> turned_;  // triangles
};

}  // namespace

Attributes attributes_of(const std::vector<ModelPart>& parts, const InstanceResult& placed,
                         const FindPicture& find, PropertyOddities& oddities) {
  return PropertyLabeler(parts, placed, find, oddities).run();
}

}  // namespace meshrepair
