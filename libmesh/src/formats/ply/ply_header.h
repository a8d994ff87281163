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

namespace meshrepair {

enum class PlyEncoding { ascii, little_endian, big_endian };
enum class PlyType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

// Bytes that a value of the type takes in a binary file.
[[nodiscard]] std::size_t size_of(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  bool is_list = false;
  PlyType count_type = PlyType::uint8;  // of a list
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;  // as declared: not to be trusted
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> elements;
  std::size_t data_at = 0;  // position of the first byte behind the header
};

// "ply" alone on the first line.
[[nodiscard]] bool begins_with_ply(std::string_view bytes);

// Needs begins_with_ply. Throws InputError, with the line, for a header that cannot be understood
// or has no end.
[[nodiscard]] PlyHeader read_ply_header(const MeshSource& source);

}  // namespace meshrepair
