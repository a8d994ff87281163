// SPDX-License-Identifier: MIT
#include "options/asset_options.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include <base/error.h>

#include "options/choice_option.h"

namespace meshrepair {
namespace {

using Kind = CornerAttribute::Kind;

constexpr std::array<Choice<bool>, 2> kScenes = {{{"join", false}, {"each", true}}};

constexpr std::array<Choice<LengthUnit>, 6> kUnits = {{{"um", LengthUnit::micron},
                                                       {"mm", LengthUnit::millimeter},
                                                       {"cm", LengthUnit::centimeter},
                                                       {"m", LengthUnit::meter},
                                                       {"in", LengthUnit::inch},
                                                       {"ft", LengthUnit::foot}}};

constexpr std::array<Choice<Kind>, 5> kCornerKinds = {{{"textures", Kind::texture},
                                                       {"normals", Kind::normal},
                                                       {"tangents", Kind::tangent},
                                                       {"colours", Kind::colour},
                                                       {"others", Kind::other}}};

constexpr const char* kAllKinds = "all";

std::vector<std::string> kinds() {
  std::vector<std::string> names = {kAllKinds};
  names.reserve(kCornerKinds.size() + 3);
  for (const auto& [name, kind] : kCornerKinds) names.emplace_back(name);
  names.insert(names.end(), {"materials", "groups"});
  return names;
}

bool is_among(const std::vector<std::string>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

void drop_chosen(const std::vector<std::string>& drops, bool keeps_scene, Attributes& attributes) {
  for (const auto& [name, kind] : kCornerKinds) {
    if (!is_among(drops, name)) continue;
    const Kind dropped = kind;
    std::erase_if(attributes.corners, [&](const CornerAttribute& one) {
      return one.kind == dropped || (dropped == Kind::other && one.kind == Kind::skin);
    });
  }
  if (is_among(drops, "materials")) {
    attributes.materials = {};
    attributes.looks.clear();
    attributes.images.clear();
    if (!keeps_scene) attributes.keepsake = nullptr;  // it has materials, too
  }
  if (is_among(drops, "others")) attributes.paints.clear();
  if (is_among(drops, "groups")) attributes.groups = attributes.smoothing = {};
}

}  // namespace

bool AssetOptions::drops_all() const { return is_among(drops, kAllKinds); }

void add_drop_option(CommandLine& app, AssetOptions& options) {
  app.add_option("--drop", options.drops,
                 "Do not write these attributes of IN: textures, normals, tangents, colours,\n"
                 "others (also paint), materials, groups; separated by commas. all: read and\n"
                 "write none of them")
      ->delimiter(',')
      ->check(is_one_of(kinds()))
      ->type_name("KIND,...")
      ->group("Output");
}

void add_scene_option(CommandLine& app, AssetOptions& options, const std::string& group) {
  add_choice(
      app, "--scene", kScenes,
      [&options](bool value) {
        options.by_mesh = value;
        options.scene_chosen = true;
      },
      "How to treat the meshes of a scene (glTF, 3MF) or the objects of an OBJ file:\n"
      "  join  place all of them and merge them into one mesh\n"
      "  each  process every mesh separately and keep the scene")
      ->default_str("join")
      ->group(group);
}

void add_units_option(CommandLine& app, AssetOptions& options) {
  add_choice(
      app, "--units", kUnits, [&options](LengthUnit value) { options.units = value; },
      "Length unit of files without one (all formats but 3MF and glTF):\n"
      "um, mm, cm, m, in or ft")
      ->default_str("keep the numbers")
      ->group("Output");
}

void add_root_option(CommandLine& app, AssetOptions& options) {
  app.add_option(
         "--root", options.root,
         "IN lies in this folder of meshes, and OUT at its place in a copy of it: names of\n"
         "files may lead anywhere in this folder, and names of pictures stay as they are")
      ->type_name("FOLDER")
      ->group("");
}

ReadOptions reading_for(SoupFormat format, const AssetOptions& assets, ReadOptions options) {
  options.attributes = !assets.drops_all() && holds_attributes(format);
  options.within = assets.root;
  options.by_mesh = assets.by_mesh;
  return options;
}

Attributes chosen_for(std::optional<SoupFormat> format, const AssetOptions& options,
                      Attributes attributes) {
  // Objects of a scene are its meshes; of a file nothing else was read.
  if (options.drops_all() && !options.by_mesh) return {};
  if (format) attributes = held_by(*format, std::move(attributes), options.by_mesh);
  drop_chosen(options.drops, options.by_mesh, attributes);
  return attributes;
}

std::optional<LengthUnit> brought_to_unit(SoupFormat output, const AssetOptions& options,
                                          std::optional<LengthUnit> unit, TriangleSoup& soup) {
  if (!unit) return options.units;
  if (has_unit(output) || !options.units) return unit;
  bring_to_unit(*unit, *options.units, soup);
  return options.units;
}

double scale_to_unit(SoupFormat output, const AssetOptions& options,
                     std::optional<LengthUnit> unit) {
  if (!unit || has_unit(output) || !options.units) return 1;
  return unit_scale(*unit, *options.units);
}

void check_format(SoupFormat format, const AssetOptions& options) {
  if (options.by_mesh && !has_instances(format) && format != SoupFormat::obj) {
    throw UsageError("--scene each: " + std::string(format_name(format)) +
                     " holds one mesh; OBJ, GLB, glTF and 3MF hold several");
  }
}

}  // namespace meshrepair
