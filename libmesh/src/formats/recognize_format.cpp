// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include <mesh/recognize_format.h>

#include "formats/common/text_scanner.h"
#include "formats/gltf/gltf_io.h"
#include "formats/off/off_io.h"
#include "formats/ply/ply_io.h"
#include "formats/stl/stl_io.h"
#include "formats/threemf/threemf_io.h"

namespace meshrepair {
namespace {

bool is_stl_keyword(std::string_view word) {
  constexpr std::array<std::string_view, 4> kWords = {"solid", "facet", "outer", "vertex"};
  return std::any_of(kWords.begin(), kWords.end(),
                     [&](std::string_view keyword) { return equals_ignoring_case(word, keyword); });
}

bool is_obj_keyword(std::string_view word) {
  constexpr std::array<std::string_view, 14> kWords = {
      "v", "vn", "vt", "vp", "f", "fo", "o", "g", "s", "l", "p", "mtllib", "usemtl", "usemap"};
  return std::find(kWords.begin(), kWords.end(), word) != kWords.end();
}

// An OFF without its keyword begins with its counts.
bool is_count(std::string_view word) {
  return word.find_first_not_of("0123456789") == std::string_view::npos;
}

// Some programs put counts before the lines of an OBJ, too: then the first word decides. The text
// stands at the first count.
SoupFormat format_with_counts(TextScanner text) {
  constexpr std::size_t kMostCounts = 8;
  for (std::size_t i = 0; i < kMostCounts && text.next_anywhere(); ++i) {
    const std::string_view word = text.peek_token();
    if (is_obj_keyword(word)) return SoupFormat::obj;
    if (!is_count(word)) break;
    text.skip_token();
  }
  return SoupFormat::off;
}

// Text, but for bytes of 0 among it, as some programs fill their names up with.
bool is_padded_ascii_stl(std::string_view bytes) {
  constexpr std::size_t kStart = 4096;
  std::string start(bytes.substr(0, kStart));
  if (start.find('\0') == std::string::npos) return false;
  std::replace(start.begin(), start.end(), '\0', ' ');
  TextScanner text(start);
  return looks_like_text(start) && text.next_anywhere() &&
         equals_ignoring_case(text.peek_token(), "solid") &&
         find_ignoring_case(start, "facet") != std::string_view::npos;
}

}  // namespace

std::optional<SoupFormat> recognize_content(std::string_view bytes) {
  if (is_glb(bytes)) return SoupFormat::glb;
  if (begins_with_zip(bytes)) {
    return is_threemf(bytes) ? std::optional(SoupFormat::threemf) : std::nullopt;
  }
  if (begins_with_ply(bytes)) return SoupFormat::ply_binary;
  if (begins_with_off(bytes)) return SoupFormat::off;
  if (is_binary_stl(bytes)) return SoupFormat::stl_binary;
  if (is_padded_ascii_stl(bytes)) return SoupFormat::stl_ascii;
  if (!looks_like_text(bytes)) return std::nullopt;
  TextScanner text(bytes, {.comment = '#'});
  if (is_gltf_text(bytes)) return SoupFormat::gltf;
  if (!text.next_anywhere()) return std::nullopt;
  const std::string_view word = text.peek_token();
  if (is_stl_keyword(word)) return SoupFormat::stl_ascii;
  if (is_obj_keyword(word)) return SoupFormat::obj;
  if (is_count(word)) return format_with_counts(text);
  return std::nullopt;
}

bool looks_like_tree(std::string_view bytes) {
  return bytes.starts_with(kTreeSignature.substr(0, 4));
}

std::string_view name_foreign_format(std::string_view bytes) {
  using namespace std::string_view_literals;
  constexpr std::array<std::pair<std::string_view, std::string_view>, 10> kSignatures = {{
      {"\x1F\x8B"sv, "compressed by gzip, in a way that is not known"},
      {"BZh"sv, "compressed by bzip2"},
      {"\xFD\x37zXZ"sv, "compressed by xz"},
      {"7z\xBC\xAF\x27\x1C"sv, "a 7z archive"},
      {"Rar!\x1A\x07"sv, "a RAR archive"},
      {"OM"sv, "a mesh of OpenMesh (.om)"},
      {"\xFF\xFE"sv, "text in UTF-16, not in UTF-8"},
      {"\xFE\xFF"sv, "text in UTF-16, not in UTF-8"},
      {"<?xml"sv, "an XML file"},
      {"ISO-10303-21"sv, "a STEP file"},
  }};
  for (const auto& [signature, name] : kSignatures) {
    if (bytes.starts_with(signature)) return name;
  }
  return {};
}

}  // namespace meshrepair
