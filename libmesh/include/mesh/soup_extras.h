// What is written of a soup besides points and triangles.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <mesh/attributes.h>

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
  // Which names of other files are relative to.
  std::filesystem::path folder = {};
};

}  // namespace meshrepair
