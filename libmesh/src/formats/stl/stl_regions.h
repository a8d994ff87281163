// SPDX-License-Identifier: MIT
// The parts of a surface that STL files tell apart: the solids of an ASCII one by their names, and
// triangles of a binary one by the numbers that some programs put into their attribute words.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <mesh/attributes.h>

namespace meshrepair {

// The name of a file's only solid.
struct StlSolidName final : Keepsake {
  std::string name;
};

// The solids of an ASCII STL as the reader meets them.
class StlSolids {
 public:
  // Triangles from this one on are of a solid of this name, which may be empty.
  void begin(std::string_view name, std::size_t triangle);
  // That solid ends; some programs say only now what it is called.
  void end(std::string_view name, std::size_t triangle);

  // Groups, where there is more than one; else what an only name is kept in.
  void take(std::size_t triangles, Attributes& attributes);

 private:
  struct Part {
    std::size_t first;  // triangle
    std::uint32_t name;
  };

  [[nodiscard]] std::uint32_t number_of(std::string_view name);

  std::vector<Part> parts_;
  std::vector<std::string> names_;
  std::unordered_map<std::string, std::uint32_t> numbers_;
};

// Groups by the attribute words of a binary STL in which none is a colour; nothing where words do
// not look like numbers of parts.
[[nodiscard]] TriangleLabels read_stl_regions(std::string_view bytes, std::size_t triangles);

}  // namespace meshrepair
