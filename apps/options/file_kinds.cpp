// SPDX-License-Identifier: MIT
#include "options/file_kinds.h"

#include <mesh/point_io.h>
#include <mesh/soup_format.h>

namespace meshrepair {
namespace {

std::string both(std::string_view some, std::string_view others) {
  return std::string(some) + ", " + std::string(others);
}

}  // namespace

Check names_file(std::string_view extensions) {
  return {[](const std::string&) { return std::string(); }, std::string(extensions)};
}

Check names_side_file(std::string_view extensions) {
  const auto why_not = [](const std::string& word) {
    return std::string(word.empty() ? "the name of the file is empty" : "");
  };
  return {why_not, std::string(extensions)};
}

std::string mesh_extensions() { return both(known_extensions(), kPackedExtensions); }

std::string point_extensions() { return both(known_point_extensions(), mesh_extensions()); }

std::string mesh_and_point_extensions() {
  return both(mesh_extensions(), known_point_extensions());
}

std::string mesh_and_tree_extensions() { return both(mesh_extensions(), kTreeExtension); }

}  // namespace meshrepair
