// Appends numbers to a text: the shortest digits that read back as the same bits, in any locale.
#pragma once

#include <array>
#include <charconv>
#include <cstdint>
#include <span>
#include <string>

#include <mesh/soup.h>

namespace meshrepair {

template <class Number>
void append_number(std::string& text, Number value) {
  std::array<char, 32> digits;
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  text.append(digits.data(), end);
}

// Three numbers with blanks between, as they stand in an Eigen vector or a std::array.
template <class Triple>
void append_triple(std::string& text, const Triple& triple) {
  append_number(text, triple[0]);
  text += ' ';
  append_number(text, triple[1]);
  text += ' ';
  append_number(text, triple[2]);
}

// A line "x y z" for each point, then one "3 a b c" for each triangle, as OFF and PLY have them;
// with `sources`, if there are any, its number at the end, signed.
inline void append_mesh_lines(std::string& text, const TriangleSoup& soup,
                              std::span<const std::uint32_t> sources = {}) {
  for (const Vec3d& point : soup.points) {
    append_triple(text, point);
    text += '\n';
  }
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    text += "3 ";
    append_triple(text, soup.triangles[t]);
    if (!sources.empty()) {
      text += ' ';
      append_number(text, static_cast<std::int32_t>(sources[t]));
    }
    text += '\n';
  }
}

}  // namespace meshrepair
