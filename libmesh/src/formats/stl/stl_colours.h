// SPDX-License-Identifier: MIT
// The colours that some programs put into the attribute word of a binary STL's triangle, five bits
// each:
//
//   VisCAM, SolidView   bit 15 set: the triangle has a colour; red is highest, blue lowest
//   Magics              the header has "COLOR=" and four bytes of red, green, blue, opacity for
//   all;
//                       bit 15 clear: the triangle has one of its own; blue is highest, red lowest
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <mesh/attributes.h>

namespace meshrepair {

// The header that says that colours are as Magics has them.
struct StlColourHeader final : Keepsake {
  std::string header;
};

// Of the triangles of a file; empty where none has a colour.
[[nodiscard]] Attributes read_stl_colours(std::string_view bytes, std::size_t triangles);

// The header's first 80 bytes, `plain` where there are no colours of Magics', and the word of each
// triangle; of corners with different colours the mean counts. No words where there are no colours.
struct StlColours {
  std::string header;
  std::vector<std::uint16_t> words;
};
[[nodiscard]] StlColours make_stl_colours(const Attributes* attributes, std::string_view plain);

}  // namespace meshrepair
