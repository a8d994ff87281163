// SPDX-License-Identifier: MIT
// The lines of .mtl files.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace meshrepair {

struct MtlLine {
  std::string_view key, rest;  // its first word, and what follows without the blanks around it
};

[[nodiscard]] MtlLine split_mtl_line(std::string_view text);

inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

// Calls visit(text of the line) for each, without its end, and without what Windows puts first.
template <class Visit>
void visit_mtl_lines(std::string_view text, const Visit& visit) {
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    visit(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

// Whether lines that begin so end with the name of a picture.
[[nodiscard]] bool names_picture(std::string_view key);

// What such a line says behind its first word: "-s 2 2 1 -clamp on the picture.png".
struct MtlMap {
  std::string_view picture;                               // its name, which may have blanks
  std::array<double, 2> offset = {0, 0}, scale = {1, 1};  // of texture coordinates: times, plus
  bool is_clamped = false;
};

[[nodiscard]] MtlMap read_mtl_map(std::string_view rest);
[[nodiscard]] std::string_view picture_of(std::string_view rest);

// With '/' between folders.
[[nodiscard]] std::string with_slashes(std::string_view name);

}  // namespace meshrepair
