// SPDX-License-Identifier: MIT
// What of an input comes along besides its triangles: options of the programs, and what they do.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <mesh/attributes.h>
#include <mesh/length_unit.h>
#include <mesh/reading.h>
#include <mesh/soup_io.h>

#include "options/command_line.h"

namespace meshrepair {

struct AssetOptions {
  // Kinds of what triangles carry, texture coordinates, materials and the like, that do not come
  // along where formats can hold them.
  std::vector<std::string> drops;
  std::size_t beam_sides = 16;      // of bodies of beams
  bool by_mesh = false;             // each mesh of a scene by itself
  bool scene_chosen = false;        // the command line says so, or the opposite
  std::optional<LengthUnit> units;  // of numbers in files that do not say
  std::string root;                 // of a folder of meshes that has a copy; empty: there is none

  // Then they are not even read.
  [[nodiscard]] bool drops_all() const;
};

// --drop.
void add_drop_option(CommandLine& app, AssetOptions& options);
// --scene.
void add_scene_option(CommandLine& app, AssetOptions& options, const std::string& group = "Repair");
// --beam-sides.
void add_beam_sides_option(CommandLine& app, AssetOptions& options);
// --units.
void add_units_option(CommandLine& app, AssetOptions& options);

// --root, for scripts: not in the help.
void add_root_option(CommandLine& app, AssetOptions& options);

// What is to be read for a file of this format.
[[nodiscard]] ReadOptions reading_for(SoupFormat format, const AssetOptions& assets,
                                      ReadOptions options);

// Of attributes those that come along into the format; without one, into memory, which holds all.
[[nodiscard]] Attributes chosen_for(std::optional<SoupFormat> format, const AssetOptions& options,
                                    Attributes attributes);

// What of a soup its unit is. `unit` is that of its file. Where the output has none either, but
// --units says one, the soup is brought to that.
[[nodiscard]] std::optional<LengthUnit> brought_to_unit(SoupFormat output,
                                                        const AssetOptions& options,
                                                        std::optional<LengthUnit> unit,
                                                        TriangleSoup& soup);
// What lengths of the file are multiplied with for that.
[[nodiscard]] double scale_to_unit(SoupFormat output, const AssetOptions& options,
                                   std::optional<LengthUnit> unit);

// Throws UsageError where the format cannot hold what is asked for.
void check_format(SoupFormat format, const AssetOptions& options);

}  // namespace meshrepair
