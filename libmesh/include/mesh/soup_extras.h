// SPDX-License-Identifier: MIT
// What is written of a soup besides points and triangles.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <mesh/attributes.h>
#include <mesh/length_unit.h>
#include <mesh/scene.h>

namespace meshrepair {

// As far as the format can hold it. Not owned.
struct SoupExtras {
  // Lines of a comment; no newlines inside.
  std::vector<std::string> comments = {};
  // For PLY alone: one number for each triangle, written as the property `source_triangle` of its
  // face, with all ones as -1. Empty: no such property.
  std::span<const std::uint32_t> sources = {};
  // Of the triangles. Null: none.
  const Attributes* attributes = nullptr;
  // Of a soup whose meshes stand one after the other: these. Null: the soup is one mesh, where it
  // is to stand.
  const Scene* scene = nullptr;
  // Of the soup. Formats that have a unit say it; glTF by the scale of a node.
  std::optional<LengthUnit> unit = std::nullopt;
  // Added to all coordinates by those who read the file: formats whose meshes have places have it
  // there. Others have comments for it.
  std::optional<Vec3d> origin = std::nullopt;
  // Which names of other files are relative to.
  std::filesystem::path folder = {};
};

}  // namespace meshrepair
