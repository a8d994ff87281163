// SPDX-License-Identifier: MIT
// The formats of triangle soups, and what each can hold.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace meshrepair {

enum class SoupFormat {
  stl_binary,
  stl_ascii,
  obj,
  off,
  ply_binary,
  ply_ascii,
  glb,
  gltf,
  threemf
};

// "binary STL", "OBJ", ...: for messages.
[[nodiscard]] std::string_view format_name(SoupFormat format);

// The format that an extension stands for, if any (.stl is binary, .ply is binary little endian).
// That of "part.obj.gz" is .obj. Case does not matter.
[[nodiscard]] std::optional<SoupFormat> format_of_extension(const std::filesystem::path& path);

// ".stl", ...: format_of_extension() gives the format, or another kind of it.
[[nodiscard]] std::string_view extension_of(SoupFormat format);

// ".stl, .obj, .off, .ply, .glb, .gltf, .3mf": for messages.
[[nodiscard]] std::string_view known_extensions();

// Whether readers weld points with equal coordinates, as the format has no indices, or splits
// points where their attributes differ.
[[nodiscard]] bool welds_points(SoupFormat format);

// Whether coordinates are single precision.
[[nodiscard]] bool is_single(SoupFormat format);

// Whether it can say of a face which triangle of the input it lies in.
[[nodiscard]] bool holds_sources(SoupFormat format);

// Whether it holds several meshes, each of which may stand in several places.
[[nodiscard]] bool has_instances(SoupFormat format);

// Whether it is known what a length of 1 is: glTF is in meters, 3MF says its unit.
[[nodiscard]] bool has_unit(SoupFormat format);

// Whether it holds any of what Attributes has.
[[nodiscard]] bool holds_attributes(SoupFormat format);

}  // namespace meshrepair
