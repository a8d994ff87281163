// SPDX-License-Identifier: MIT
// The header of a PLY file.
//
//   ply
//   format ascii|binary_little_endian|binary_big_endian 1.0
//   comment ... | obj_info ...
//   element NAME COUNT
//   property TYPE NAME
//   property list COUNT_TYPE TYPE NAME
//   end_header
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <mesh/mesh_source.h>

#include "formats/common/value_type.h"

namespace meshrepair {

enum class PlyEncoding { ascii, little_endian, big_endian };
struct PlyProperty {
  std::string name;
  ValueType type = ValueType::float32;
  bool is_list = false;
  ValueType count_type = ValueType::uint8;  // of a list
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;  // as declared: not to be trusted
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> elements;
  std::vector<std::string> comments;  // without the word and the blanks around
  std::size_t data_at = 0;            // position of the first byte behind the header
};

// Needs begins_with_ply(). Throws InputError, with the line, for a header that cannot be understood
// or has no end.
[[nodiscard]] PlyHeader read_ply_header(const MeshSource& source);

}  // namespace meshrepair
