// SPDX-License-Identifier: MIT
#include "ply_attributes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <utility>

#include <base/ids.h>
#include <mesh/named_files.h>

#include "ply_names.h"

namespace meshrepair {
namespace {

using Kind = CornerAttribute::Kind;
using Place = CornerAttribute::Place;
using Storage = CornerAttribute::Storage;
using Names = std::vector<std::string_view>;

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

struct KnownGroup {
  Kind kind;
  Names names;
  std::size_t least;  // so many of them have to be there
};

const std::vector<KnownGroup>& known_groups() {
  static const std::vector<KnownGroup> groups = {
      {Kind::texture, {"s", "t"}, 2},
      {Kind::texture, {"u", "v"}, 2},
      {Kind::texture, {"texture_u", "texture_v"}, 2},
      {Kind::texture, {"texture_s", "texture_t"}, 2},
      {Kind::normal, {"nx", "ny", "nz"}, 3},
      {Kind::tangent, {"tangent_0", "tangent_1", "tangent_2", "tangent_3"}, 4},
      {Kind::colour, {"red", "green", "blue", "alpha"}, 3},
      {Kind::colour, {"diffuse_red", "diffuse_green", "diffuse_blue", "diffuse_alpha"}, 3},
      {Kind::colour, {"r", "g", "b", "a"}, 3}};
  return groups;
}

// Properties that are no attributes.
bool is_known_otherwise(std::string_view name) {
  constexpr std::array<std::string_view, 4> kNames = {"x", "y", "z", kPlySource};
  return std::find(kNames.begin(), kNames.end(), name) != kNames.end();
}

Storage storage_of(ValueType type, Kind kind) {
  if (type == ValueType::float32) return Storage::real32;
  if (type == ValueType::float64) return Storage::real64;
  return kind == Kind::colour && type == ValueType::uint8 ? Storage::byte : Storage::integer;
}

// 0-based, of a list with so many entries.
std::uint32_t index_of(double value, std::size_t count) {
  return value >= 0 && value < static_cast<double>(count) ? static_cast<std::uint32_t>(value)
                                                          : kNone;
}

std::string_view behind(std::string_view comment, std::string_view word) {
  if (!comment.starts_with(word) || comment.size() <= word.size()) return {};
  return comment[word.size()] == ' ' ? comment.substr(word.size() + 1) : std::string_view();
}

// As the file means it: a text may have more digits than the type holds.
double as_stored(double value, Storage storage) {
  if (storage == Storage::real32) return static_cast<double>(static_cast<float>(value));
  return storage == Storage::byte ? value / 255 : value;
}

bool is_nothing(const CornerAttribute& attribute, std::size_t value) {
  const double* const first = attribute.values.data() + attribute.components * value;
  return std::all_of(first, first + attribute.components, [](double x) { return std::isnan(x); });
}

// "NAME_0", "NAME_1" and so on, of one type, are one attribute, if they are as many as others hold
// in one, too; else the property alone.
Names components_from(const PlyElement& element, std::size_t first) {
  const auto& properties = element.properties;
  Names names = {properties[first].name};
  if (!properties[first].name.ends_with("_0")) return names;
  const std::string base = properties[first].name.substr(0, properties[first].name.size() - 1);
  for (std::size_t i = first + 1; i < properties.size(); ++i) {
    const bool follows = !properties[i].is_list && properties[i].type == properties[first].type &&
                         properties[i].name == base + std::to_string(names.size());
    if (!follows) break;
    names.push_back(properties[i].name);
  }
  constexpr std::array<std::size_t, 5> kHeld = {2, 3, 4, 9, 16};
  const bool is_held = std::find(kHeld.begin(), kHeld.end(), names.size()) != kHeld.end();
  return is_held ? names : Names{properties[first].name};
}

}  // namespace

PlyAttributes::PlyAttributes(const MeshSource& source, const PlyHeader& header) : source_(source) {
  for (const auto& [word, named] : {std::pair(kPlyMaterialComment, &materials_),
                                    {kPlyTextureComment, &textures_},
                                    {kPlyGroupComment, &groups_},
                                    {kPlyObjectComment, &objects_}}) {
    for (const std::string& comment : header.comments) {
      if (const auto name = behind(comment, word); !name.empty()) named->names.emplace_back(name);
    }
  }
  find_element("vertex", header, points_);
  find_element("face", header, faces_);
}

// Where there are several, each has properties of its own: they do not make one list.
void PlyAttributes::find_element(std::string_view name, const PlyHeader& header, Element& found) {
  const auto is_it = [&](const PlyElement& element) { return element.name == name; };
  const auto& all = header.elements;
  if (std::count_if(all.begin(), all.end(), is_it) != 1) return;
  find_groups(*std::find_if(all.begin(), all.end(), is_it), found);
}

void PlyAttributes::find_groups(const PlyElement& element, Element& found) {
  found.group_of.assign(element.properties.size(), kNoColumn);
  found.component_of.assign(element.properties.size(), 0);
  for (const KnownGroup& known : known_groups()) {
    add_group(element, known.kind, known.names, known.least, found);
  }
  const bool is_face = element.name == "face";
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const PlyProperty& property = element.properties[i];
    if (property.is_list && is_face && property.name.starts_with(kPlyTextureList)) {
      add_list(element, i, found);
    }
    if (!is_face || property.is_list) continue;
    // Numbers of what has no names are any numbers.
    for (const auto& [word, named] : {std::pair(kPlyMaterial, &materials_),
                                      {kPlyTexture, &textures_},
                                      {kPlyGroup, &groups_},
                                      {kPlyObject, &objects_}}) {
      if (property.name == word && !named->names.empty()) named->property = i;
    }
  }
  add_others(element, found);
}

void PlyAttributes::add_group(const PlyElement& element, Kind kind, const Names& names,
                              std::size_t least, Element& found) const {
  Group group;
  for (const std::string_view name : names) {
    const auto property =
        std::find_if(element.properties.begin(), element.properties.end(),
                     [&](const PlyProperty& p) { return !p.is_list && p.name == name; });
    if (property == element.properties.end()) break;
    group.properties.push_back(static_cast<std::size_t>(property - element.properties.begin()));
  }
  if (group.properties.size() < least) return;
  group.attribute.kind = kind;
  group.attribute.components = group.properties.size();
  group.attribute.place = element.name == "face" ? Place::triangle : Place::point;
  group.attribute.storage = storage_of(element.properties[group.properties.front()].type, kind);
  for (std::size_t i = 0; i < group.properties.size(); ++i) {
    found.group_of[group.properties[i]] = found.groups.size();
    found.component_of[group.properties[i]] = i;
  }
  found.groups.push_back(std::move(group));
}

void PlyAttributes::add_list(const PlyElement& element, std::size_t property,
                             Element& found) const {
  Group group;
  group.is_list = true;
  group.properties = {property};
  group.attribute.kind = Kind::texture;
  group.attribute.storage = storage_of(element.properties[property].type, Kind::texture);
  found.group_of[property] = found.groups.size();
  found.groups.push_back(std::move(group));
}

void PlyAttributes::add_others(const PlyElement& element, Element& found) const {
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const PlyProperty& property = element.properties[i];
    const bool is_label = element.name == "face" && is_name(i);
    if (property.is_list || found.group_of[i] != kNoColumn || is_label ||
        is_known_otherwise(property.name)) {
      continue;
    }
    const Names vector = components_from(element, i);
    add_group(element, Kind::other, vector, vector.size(), found);
    if (found.group_of[i] == kNoColumn) continue;
    std::string_view name = property.name;
    if (vector.size() > 1) name.remove_suffix(std::string_view("_0").size());
    found.groups.back().attribute.name = name;
  }
}

bool PlyAttributes::is_name(std::size_t property) const {
  return property == materials_.property || property == textures_.property ||
         property == groups_.property || property == objects_.property;
}

void PlyAttributes::begin_element(const PlyElement& element) {
  current_ = nullptr;
  if (element.name == "vertex" && points_.any()) current_ = &points_;
  if (element.name == "face" && faces_.any()) current_ = &faces_;
  row_.assign(element.properties.size(), kNoNumber);
  list_.assign(current_ == nullptr ? 0 : current_->groups.size(), {});
}

void PlyAttributes::add(std::size_t property, double value) {
  if (current_ == nullptr) return;
  const std::size_t group = current_->group_of[property];
  if (group != kNoColumn && current_->groups[group].is_list) {
    list_[group].push_back(value);
  } else {
    row_[property] = value;
  }
}

void PlyAttributes::forget_item() {
  std::fill(row_.begin(), row_.end(), kNoNumber);
  for (std::vector<double>& list : list_) list.clear();
}

void PlyAttributes::keep_row() {
  for (Group& group : current_->groups) {
    if (group.is_list) continue;
    const Storage storage = group.attribute.storage;
    for (const std::size_t property : group.properties) {
      group.attribute.values.push_back(as_stored(row_[property], storage));
    }
  }
}

void PlyAttributes::end_point() {
  if (current_ == nullptr) return;
  keep_row();
  forget_item();
}

// A list that does not have two numbers for each corner says nothing.
void PlyAttributes::end_lists(std::size_t corners) {
  for (std::size_t g = 0; g < current_->groups.size(); ++g) {
    Group& group = current_->groups[g];
    if (!group.is_list) continue;
    CornerAttribute& attribute = group.attribute;
    const bool fits = list_[g].size() == 2 * corners;
    for (std::size_t k = 0; k < corners; ++k) {
      attribute.of_corner.push_back(fits ? static_cast<std::uint32_t>(attribute.count() + k)
                                         : kNone);
    }
    if (fits) {
      for (const double value : list_[g]) {
        attribute.values.push_back(as_stored(value, attribute.storage));
      }
    }
  }
}

void PlyAttributes::end_face(std::size_t corners) {
  if (current_ == nullptr) return;
  keep_row();
  end_lists(corners);
  for (Named* const named : {&materials_, &textures_, &groups_, &objects_}) {
    if (named->is_there()) named->of_face.push_back(row_[named->property]);
  }
  forget_item();
}

void PlyAttributes::drop_face(std::size_t corners) {
  for (Group& group : faces_.groups) {
    CornerAttribute& attribute = group.attribute;
    if (group.is_list) {
      attribute.of_corner.resize(corners);
    } else {
      attribute.values.resize(attribute.values.size() - attribute.components);
    }
  }
  for (Named* const named : {&materials_, &textures_, &groups_, &objects_}) {
    if (named->is_there()) named->of_face.pop_back();
  }
}

CornerAttribute PlyAttributes::take_of_points(
    Group& group, const std::vector<std::array<std::uint32_t, 3>>& triangles) const {
  CornerAttribute taken = std::move(group.attribute);
  taken.of_corner.reserve(3 * triangles.size());
  for (const auto& triangle : triangles) {
    for (const std::uint32_t p : triangle) {
      const bool has_one = p < taken.count() && !is_nothing(taken, p);
      taken.of_corner.push_back(has_one ? p : kNone);
    }
  }
  return taken;
}

CornerAttribute PlyAttributes::take_of_faces(Group& group,
                                             const std::vector<FaceList::Origin>& origins) const {
  CornerAttribute taken = std::move(group.attribute);
  const std::vector<std::uint32_t> of_corner = std::exchange(taken.of_corner, {});
  taken.of_corner.reserve(3 * origins.size());
  for (const FaceList::Origin& origin : origins) {
    for (const std::size_t corner : origin.corners) {
      if (group.is_list) {
        taken.of_corner.push_back(of_corner[corner]);
      } else {
        const bool has_one = origin.face < taken.count() && !is_nothing(taken, origin.face);
        taken.of_corner.push_back(has_one ? origin.face : kNone);
      }
    }
  }
  share_values(taken);
  return taken;
}

// Materials have names of their own, or else are the textures.
void PlyAttributes::take_materials(const std::vector<FaceList::Origin>& origins,
                                   Attributes& attributes) {
  const std::vector<std::string>& textures = textures_.names;
  for (const std::string& name : textures) {
    Image image = picture_named(source_, name);
    if (image.path.empty() && !image.bytes) image.name = name;  // as it stands there
    attributes.images.push_back(std::move(image));
  }
  const bool by_texture = !materials_.is_there();
  const std::vector<double>& numbers = by_texture ? textures_.of_face : materials_.of_face;
  attributes.materials.names = by_texture ? textures : materials_.names;
  const std::size_t count = attributes.materials.names.size();
  if (count == 0) return;
  attributes.looks.resize(count);
  for (const FaceList::Origin& origin : origins) {
    const bool is_all_one = by_texture && numbers.empty();
    const std::uint32_t material = is_all_one ? 0 : index_of(numbers[origin.face], count);
    attributes.materials.of_triangle.push_back(material);
    if (material == kNone || textures.empty()) continue;
    attributes.looks[material].image =
        by_texture || textures_.of_face.empty()
            ? index_of(material, textures.size())
            : index_of(textures_.of_face[origin.face], textures.size());
  }
}

TriangleLabels PlyAttributes::Named::take(const std::vector<FaceList::Origin>& origins) {
  TriangleLabels labels;
  if (!is_there()) return labels;
  for (const FaceList::Origin& origin : origins) {
    labels.of_triangle.push_back(index_of(of_face[origin.face], names.size()));
  }
  labels.names = std::move(names);
  return labels;
}

Attributes PlyAttributes::take(const std::vector<FaceList::Origin>& origins,
                               const std::vector<std::array<std::uint32_t, 3>>& triangles,
                               bool with_faces) {
  Attributes attributes;
  for (Group& group : points_.groups) {
    attributes.corners.push_back(take_of_points(group, triangles));
  }
  if (with_faces) {
    for (Group& group : faces_.groups) {
      attributes.corners.push_back(take_of_faces(group, origins));
    }
    take_materials(origins, attributes);
    attributes.groups = groups_.take(origins);
    attributes.objects = objects_.take(origins);
  }
  std::erase_if(attributes.corners, [](const CornerAttribute& attribute) {
    return std::all_of(attribute.of_corner.begin(), attribute.of_corner.end(),
                       [](std::uint32_t value) { return value == kNone; });
  });
  std::stable_sort(
      attributes.corners.begin(), attributes.corners.end(),
      [](const CornerAttribute& a, const CornerAttribute& b) { return a.kind < b.kind; });
  return attributes;
}

}  // namespace meshrepair
