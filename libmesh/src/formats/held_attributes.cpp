// SPDX-License-Identifier: MIT
#include "held_attributes.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <base/ids.h>
#include <mesh/placed_pictures.h>
#include <mesh/soup_io.h>

#include "formats/common/regions.h"
#include "formats/obj/obj_io.h"
#include "formats/painted_materials.h"
#include "formats/stl/stl_io.h"

namespace meshrepair {
namespace {

using Kind = CornerAttribute::Kind;

// Which lists of names: one as groups or as objects, both, or smoothing groups, too.
enum class Names { none, numbers, groups, objects, both, all };

struct Held {
  std::size_t textures = 0;  // sets of coordinates
  bool normals = false;
  bool colours = false;
  bool others = false;  // tangents, too
  bool skins = false;
  bool materials = false;
  Names names = Names::none;
};

constexpr std::size_t kAny = std::numeric_limits<std::size_t>::max();

Held held_by(SoupFormat format) {
  switch (format) {
    case SoupFormat::stl_binary:
      return {.colours = true, .names = Names::numbers};
    case SoupFormat::stl_ascii:
      return {.names = Names::groups};
    case SoupFormat::off:
      return {};
    case SoupFormat::obj:
      return {
          .textures = 1, .normals = true, .colours = true, .materials = true, .names = Names::all};
    case SoupFormat::threemf:
      return {.textures = 1, .colours = true, .materials = true, .names = Names::both};
    case SoupFormat::ply_binary:
    case SoupFormat::ply_ascii:
    case SoupFormat::glb:
    case SoupFormat::gltf:
      break;
  }
  const bool is_ply = holds_sources(format);
  return {.textures = kAny,
          .normals = true,
          .colours = true,
          .others = true,
          .skins = !is_ply,
          .materials = true,
          .names = is_ply ? Names::both : Names::objects};
}

bool holds(const Held& held, const CornerAttribute& attribute, std::size_t& textures) {
  switch (attribute.kind) {
    case Kind::texture:
      return textures++ < held.textures;
    case Kind::normal:
      return held.normals;
    case Kind::colour:
      return held.colours;
    case Kind::skin:
      return held.skins;
    case Kind::tangent:
    case Kind::other:
      break;
  }
  return held.others;
}

// Each name of glTF is a node with a mesh, which takes far more room than the triangle that it may
// be of.
constexpr std::size_t kMostNodes = 65'536;

// A package has one object, and groups in it.
void keep_one_object(Attributes& attributes) {
  const TriangleLabels& objects = attributes.objects;
  const auto& labels = objects.of_triangle;
  const bool is_one = std::all_of(labels.begin(), labels.end(), [&](std::uint32_t label) {
    return label != kNone && label == labels.front();
  });
  if (is_one) return;
  attributes.groups = regions_of(attributes);
  attributes.objects = {};
}

void keep_numbers(Attributes& attributes) {
  const bool has_colours = find_kind(attributes, Kind::colour) != nullptr;
  attributes.groups = regions_of(attributes);
  attributes.objects = {};
  if (has_colours || stl_region_words(attributes.groups).empty()) attributes.groups = {};
}

void keep_names(SoupFormat format, Names names, bool by_mesh, Attributes& attributes) {
  if (names != Names::all) attributes.smoothing = {};
  switch (names) {
    case Names::none:
      attributes.groups = attributes.objects = {};
      break;
    case Names::numbers:
      return keep_numbers(attributes);
    case Names::groups:
      attributes.groups = regions_of(attributes);
      attributes.objects = {};
      break;
    case Names::objects:
      if (!by_mesh) attributes.objects = regions_of(attributes);
      attributes.groups = {};
      if (!by_mesh && used_names(attributes.objects) > kMostNodes) attributes.objects = {};
      break;
    case Names::both:
      if (format == SoupFormat::threemf && !by_mesh) keep_one_object(attributes);
      break;
    case Names::all:
      break;
  }
}

}  // namespace

std::optional<Attributes> placed_for(SoupFormat format, const Attributes& attributes) {
  if (format == SoupFormat::glb || format == SoupFormat::gltf) return std::nullopt;
  if (format != SoupFormat::obj) return with_placed_pictures(attributes);
  return with_placed_pictures(attributes, library_materials(attributes));
}

Attributes held_by(SoupFormat format, Attributes attributes, bool by_mesh) {
  const Held held = held_by(format);
  if (format != SoupFormat::threemf) {
    if (held.materials) make_materials_of_paint(attributes);
    attributes.paints.clear();
  }
  // Before sets go that pictures may lie by.
  if (held.materials && held.textures == 1) {
    if (auto placed = placed_for(format, attributes)) attributes = std::move(*placed);
  }
  std::size_t textures = 0;
  std::erase_if(attributes.corners, [&](const CornerAttribute& attribute) {
    return !holds(held, attribute, textures);
  });
  if (!held.materials) {
    attributes.materials = {};
    attributes.looks.clear();
    attributes.images.clear();
  }
  keep_names(format, held.names, by_mesh, attributes);
  return attributes;
}

}  // namespace meshrepair
