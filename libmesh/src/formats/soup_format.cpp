// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include <base/assert.h>
#include <mesh/packing.h>
#include <mesh/soup_format.h>

#include "formats/common/text_scanner.h"

namespace meshrepair {
namespace {

// Where formats share an extension, it stands for the first.
constexpr std::array<std::pair<std::string_view, SoupFormat>, 9> kExtensions = {{
    {".stl", SoupFormat::stl_binary},
    {".stl", SoupFormat::stl_ascii},
    {".obj", SoupFormat::obj},
    {".off", SoupFormat::off},
    {".ply", SoupFormat::ply_binary},
    {".ply", SoupFormat::ply_ascii},
    {".glb", SoupFormat::glb},
    {".gltf", SoupFormat::gltf},
    {".3mf", SoupFormat::threemf},
}};

bool is_any_gltf(SoupFormat format) {
  return format == SoupFormat::glb || format == SoupFormat::gltf;
}

}  // namespace

std::string_view format_name(SoupFormat format) {
  switch (format) {
    case SoupFormat::stl_binary:
      return "binary STL";
    case SoupFormat::stl_ascii:
      return "ASCII STL";
    case SoupFormat::obj:
      return "OBJ";
    case SoupFormat::off:
      return "OFF";
    case SoupFormat::ply_binary:
      return "binary PLY";
    case SoupFormat::threemf:
      return "3MF";
    case SoupFormat::ply_ascii:
      return "ASCII PLY";
    case SoupFormat::glb:
      return "binary glTF";
    case SoupFormat::gltf:
      break;
  }
  return "glTF";
}

std::optional<SoupFormat> format_of_extension(const std::filesystem::path& path) {
  const std::string extension = without_packing(path).extension().string();
  for (const auto& [name, format] : kExtensions) {
    if (equals_ignoring_case(extension, name)) return format;
  }
  return std::nullopt;
}

std::string_view extension_of(SoupFormat format) {
  const auto* const found = std::find_if(kExtensions.begin(), kExtensions.end(),
                                         [&](const auto& entry) { return entry.second == format; });
  MESHREPAIR_ASSERT(found != kExtensions.end());
  return found->first;
}

std::string_view known_extensions() { return ".stl, .obj, .off, .ply, .glb, .gltf, .3mf"; }

bool welds_points(SoupFormat format) {
  return format == SoupFormat::stl_binary || format == SoupFormat::stl_ascii || is_any_gltf(format);
}

bool is_single(SoupFormat format) {
  return format == SoupFormat::stl_binary || is_any_gltf(format);
}

bool holds_sources(SoupFormat format) {
  return format == SoupFormat::ply_binary || format == SoupFormat::ply_ascii;
}

bool has_instances(SoupFormat format) {
  return format == SoupFormat::threemf || is_any_gltf(format);
}

bool has_unit(SoupFormat format) { return format == SoupFormat::threemf || is_any_gltf(format); }

bool holds_attributes(SoupFormat format) { return format != SoupFormat::off; }

}  // namespace meshrepair
