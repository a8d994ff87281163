// SPDX-License-Identifier: MIT
#include "held_attributes.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <mesh/placed_pictures.h>
#include <mesh/soup_io.h>

#include "formats/obj/obj_io.h"
#include "formats/painted_materials.h"

namespace meshrepair {
namespace {

using Kind = CornerAttribute::Kind;

struct Held {
  std::size_t textures = 0;  // sets of coordinates
  bool normals = false;
  bool colours = false;
  bool others = false;  // tangents, too
  bool materials = false;
  bool groups = false;  // and objects and smoothing
};

constexpr std::size_t kAny = std::numeric_limits<std::size_t>::max();

Held held_by(SoupFormat format) {
  switch (format) {
    case SoupFormat::stl_binary:
      return {.colours = true};
    case SoupFormat::stl_ascii:
    case SoupFormat::off:
      return {};
    case SoupFormat::obj:
      return {.textures = 1, .normals = true, .colours = true, .materials = true, .groups = true};
    case SoupFormat::threemf:
      return {.textures = 1, .colours = true, .materials = true};
    case SoupFormat::ply_binary:
    case SoupFormat::ply_ascii:
    case SoupFormat::glb:
    case SoupFormat::gltf:
      break;
  }
  return {.textures = kAny, .normals = true, .colours = true, .others = true, .materials = true};
}

bool holds(const Held& held, const CornerAttribute& attribute, std::size_t& textures) {
  switch (attribute.kind) {
    case Kind::texture:
      return textures++ < held.textures;
    case Kind::normal:
      return held.normals;
    case Kind::colour:
      return held.colours;
    case Kind::tangent:
    case Kind::other:
      break;
  }
  return held.others;
}

}  // namespace

std::optional<Attributes> placed_for(SoupFormat format, const Attributes& attributes) {
  if (format == SoupFormat::glb || format == SoupFormat::gltf) return std::nullopt;
  if (format != SoupFormat::obj) return with_placed_pictures(attributes);
  return with_placed_pictures(attributes, library_materials(attributes));
}

Attributes held_by(SoupFormat format, Attributes attributes) {
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
  if (!held.groups) attributes.groups = attributes.objects = attributes.smoothing = {};
  return attributes;
}

}  // namespace meshrepair
