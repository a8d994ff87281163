// SPDX-License-Identifier: MIT
// Appends numbers to a text: the shortest digits that read back as the same bits, in any locale.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>

#include <base/decimal.h>
#include <base/parallel.h>
#include <mesh/soup.h>

namespace meshrepair {

template <class Number>
void append_number(std::string& text, Number value) {
  std::array<char, 32> digits;
  const auto [end, error] = write_decimal(digits.data(), digits.data() + digits.size(), value);
  text.append(digits.data(), static_cast<std::size_t>(end - digits.data()));
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

// What append(text, i) appends for each i below `count`. On several threads, and of so many lines
// at a time that little of the text is there twice.
template <class Append>
void append_lines(std::string& text, std::size_t count, const Append& append) {
  constexpr std::size_t kLinesPerTask = 4096, kLinesAtATime = 64 * kLinesPerTask;
  for (std::size_t begin = 0; begin < count; begin += kLinesAtATime) {
    const auto lines_of = [&](std::size_t first, std::size_t last) {
      std::string lines;
      for (std::size_t i = first; i < last; ++i) append(lines, begin + i);
      return lines;
    };
    parallel_reduce(std::min(kLinesAtATime, count - begin), kLinesPerTask, lines_of,
                    [&](std::string&, const std::string& lines) { text += lines; });
  }
}

// A line "x y z" for each point, then one "3 a b c" for each triangle, as OFF and PLY have them;
// with `sources`, if there are any, its number at the end, signed.
inline void append_mesh_lines(std::string& text, const TriangleSoup& soup,
                              std::span<const std::uint32_t> sources = {}) {
  append_lines(text, soup.points.size(), [&](std::string& lines, std::size_t p) {
    append_triple(lines, soup.points[p]);
    lines += '\n';
  });
  append_lines(text, soup.triangles.size(), [&](std::string& lines, std::size_t t) {
    lines += "3 ";
    append_triple(lines, soup.triangles[t]);
    if (!sources.empty()) {
      lines += ' ';
      append_number(lines, static_cast<std::int32_t>(sources[t]));
    }
    lines += '\n';
  });
}

}  // namespace meshrepair
