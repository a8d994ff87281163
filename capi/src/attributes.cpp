// SPDX-License-Identifier: MIT
// What meshes of the C interface carry.
#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include <spdlog/fmt/fmt.h>

#include <base/error.h>
#include <base/ids.h>

#include "calls/attribute_keys.h"
#include "handles.h"

namespace meshrepair {
namespace {

static_assert(MESHREPAIR_NONE == kNone);

const CornerAttribute* attribute_at(const meshrepair_mesh* mesh, std::size_t index) {
  if (mesh == nullptr || index >= mesh->it.attributes.corners.size()) return nullptr;
  return &mesh->it.attributes.corners[index];
}

constexpr std::array<TriangleLabels Attributes::*, 4> kLabels = {
    &Attributes::materials, &Attributes::groups, &Attributes::objects, &Attributes::smoothing};

const TriangleLabels* labels_at(const meshrepair_mesh* mesh, int label) {
  if (mesh == nullptr || label < 0 || std::cmp_greater_equal(label, kLabels.size())) return nullptr;
  return &(mesh->it.attributes.*kLabels[static_cast<std::size_t>(label)]);
}

// As many numbers as asked for, each below `count` or none.
std::vector<std::uint32_t> numbers_of(const std::uint32_t* numbers, std::size_t size,
                                      std::size_t count, const std::string& name) {
  if (numbers == nullptr && size > 0) throw UsageError(name + ": there is NULL for numbers");
  std::vector<std::uint32_t> copy(size);
  for (std::size_t i = 0; i < size; ++i) {
    if (numbers[i] != kNone && numbers[i] >= count) {
      throw UsageError(
          fmt::format("{}: number {} is {}, but there are {}", name, i, numbers[i], count));
    }
    copy[i] = numbers[i];
  }
  return copy;
}

// Points have no triangles to carry anything; a repair would take what they carry for that of the
// triangles it makes.
void check_mesh(const meshrepair_mesh* mesh) {
  if (mesh == nullptr) throw UsageError("there is NULL for a mesh");
  if (mesh->it.cloud) throw UsageError("the mesh is points of a scan, which carry nothing");
}

// Numbers in names say nothing but the order in which attributes of a kind were added.
void check_number(const meshrepair_mesh& mesh, const CornerAttribute& attribute,
                  const std::string& name) {
  if (attribute.kind == CornerAttribute::Kind::other) return;
  const std::vector<CornerAttribute>& all = mesh.it.attributes.corners;
  const auto count = std::count_if(all.begin(), all.end(),
                                   [&](const auto& a) { return a.kind == attribute.kind; });
  const std::string next = attribute_key(attribute, static_cast<std::size_t>(count));
  if (name == next || name == attribute_key(attribute, 0)) return;
  throw UsageError(fmt::format("{}: the next of its kind is {}", name, next));
}

CornerAttribute attribute_of(const std::string& name, std::size_t components, const double* values,
                             std::size_t value_count) {
  CornerAttribute attribute;
  attribute.kind = kind_of_key(name);
  if (attribute.kind == CornerAttribute::Kind::other) attribute.name = name;
  attribute.place = CornerAttribute::Place::corner;
  attribute.components = components;
  check_components(attribute, name);
  if (value_count >= kNone) throw UsageError(name + ": has too many values");
  if (values == nullptr && value_count > 0) throw UsageError(name + ": there is NULL for values");
  if (value_count > 0) attribute.values.assign(values, values + components * value_count);
  return attribute;
}

}  // namespace
}  // namespace meshrepair

using namespace meshrepair;

size_t meshrepair_mesh_attribute_count(const meshrepair_mesh* mesh) {
  return mesh == nullptr ? 0 : mesh->it.attributes.corners.size();
}

const char* meshrepair_mesh_attribute_name(const meshrepair_mesh* mesh, size_t index) {
  return attribute_at(mesh, index) == nullptr ? nullptr : mesh->attribute_names[index].c_str();
}

size_t meshrepair_mesh_attribute_components(const meshrepair_mesh* mesh, size_t index) {
  const CornerAttribute* const attribute = attribute_at(mesh, index);
  return attribute == nullptr ? 0 : attribute->components;
}

size_t meshrepair_mesh_attribute_value_count(const meshrepair_mesh* mesh, size_t index) {
  const CornerAttribute* const attribute = attribute_at(mesh, index);
  return attribute == nullptr ? 0 : attribute->count();
}

const double* meshrepair_mesh_attribute_values(const meshrepair_mesh* mesh, size_t index) {
  const CornerAttribute* const attribute = attribute_at(mesh, index);
  return attribute == nullptr ? nullptr : attribute->values.data();
}

const uint32_t* meshrepair_mesh_attribute_corners(const meshrepair_mesh* mesh, size_t index) {
  const CornerAttribute* const attribute = attribute_at(mesh, index);
  return attribute == nullptr ? nullptr : attribute->of_corner.data();
}

meshrepair_code meshrepair_mesh_add_attribute(meshrepair_mesh* mesh, const char* name,
                                              size_t components, const double* values,
                                              size_t value_count, const uint32_t* corners) {
  return guarded([&] {
    check_mesh(mesh);
    if (name == nullptr || *name == '\0') throw UsageError("the attribute has no name");
    CornerAttribute attribute = attribute_of(name, components, values, value_count);
    attribute.of_corner =
        numbers_of(corners, 3 * mesh->it.soup.triangles.size(), value_count, name);
    check_number(*mesh, attribute, name);
    share_values(attribute);
    meshrepair_mesh changed;
    changed.it.attributes.corners = mesh->it.attributes.corners;
    changed.it.attributes.corners.push_back(std::move(attribute));
    std::stable_sort(changed.it.attributes.corners.begin(), changed.it.attributes.corners.end(),
                     [](const auto& a, const auto& b) { return a.kind < b.kind; });
    changed.name_attributes();
    mesh->it.attributes.corners.swap(changed.it.attributes.corners);
    mesh->attribute_names.swap(changed.attribute_names);
  });
}

size_t meshrepair_mesh_label_count(const meshrepair_mesh* mesh, int label) {
  const TriangleLabels* const labels = labels_at(mesh, label);
  return labels == nullptr || labels->empty() ? 0 : labels->names.size();
}

const char* meshrepair_mesh_label_name(const meshrepair_mesh* mesh, int label, size_t index) {
  if (index >= meshrepair_mesh_label_count(mesh, label)) return nullptr;
  return labels_at(mesh, label)->names[index].c_str();
}

const uint32_t* meshrepair_mesh_labels(const meshrepair_mesh* mesh, int label) {
  const TriangleLabels* const labels = labels_at(mesh, label);
  return labels == nullptr || labels->empty() ? nullptr : labels->of_triangle.data();
}

meshrepair_code meshrepair_mesh_set_labels(meshrepair_mesh* mesh, int label,
                                           const char* const* names, size_t name_count,
                                           const uint32_t* labels) {
  return guarded([&] {
    check_mesh(mesh);
    if (labels_at(mesh, label) == nullptr) throw UsageError("there is no such label");
    TriangleLabels made;
    for (std::size_t i = 0; i < name_count; ++i) {
      if (names == nullptr || names[i] == nullptr) throw UsageError("there is NULL for a name");
      made.names.emplace_back(names[i]);
    }
    const bool is_removal = labels == nullptr && name_count == 0;
    if (!is_removal) {
      made.of_triangle = numbers_of(labels, mesh->it.soup.triangles.size(), name_count, "labels");
    }
    Attributes& attributes = mesh->it.attributes;
    const bool is_known = label != MESHREPAIR_MATERIAL || made.names == attributes.materials.names;
    if (!is_known) {
      attributes.looks.clear();
      attributes.images.clear();
      attributes.keepsake.reset();
    }
    attributes.*kLabels[static_cast<std::size_t>(label)] = std::move(made);
  });
}
