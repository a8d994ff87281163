// SPDX-License-Identifier: MIT
#include "ply_header.h"

#include <array>
#include <optional>
#include <utility>

#include "formats/common/text_scanner.h"

namespace meshrepair {
namespace {

std::optional<ValueType> parse_type(std::string_view word) {
  static constexpr std::array<std::pair<std::string_view, ValueType>, 19> kTypes = {{
      {"bool", ValueType::uint8},      {"char", ValueType::int8},
      {"int8", ValueType::int8},       {"uchar", ValueType::uint8},
      {"uint8", ValueType::uint8},     {"short", ValueType::int16},
      {"int16", ValueType::int16},     {"ushort", ValueType::uint16},
      {"uint16", ValueType::uint16},   {"int", ValueType::int32},
      {"int32", ValueType::int32},     {"uint", ValueType::uint32},
      {"uint32", ValueType::uint32},   {"int64", ValueType::int64},
      {"uint64", ValueType::uint64},   {"float", ValueType::float32},
      {"float32", ValueType::float32}, {"double", ValueType::float64},
      {"float64", ValueType::float64},
  }};
  for (const auto& [name, type] : kTypes) {
    if (word == name) return type;
  }
  return std::nullopt;
}

class PlyHeaderReader {
 public:
  explicit PlyHeaderReader(const MeshSource& source) : source_(source), text_(source.bytes) {}

  PlyHeader run() {
    text_.skip_line();
    bool has_format = false;
    while (text_.next_anywhere()) {
      line_at_ = text_.position();
      const std::string_view word = text_.peek_token();
      text_.skip_token();
      if (word == "format") {
        read_format();
        has_format = true;
      } else if (word == "element") {
        read_element();
      } else if (word == "property") {
        read_property();
      } else if (word == "end_header") {
        if (!has_format) source_.fail("the PLY header does not say which format");
        end_header();
        return std::move(header_);
      } else if (word == "comment") {
        header_.comments.emplace_back(text_.rest_of_line());
      } else if (word != "obj_info") {
        fail("unknown word '" + printable(word) + "' in the PLY header");
      }
      text_.skip_line();
    }
    source_.fail("the PLY header has no end_header");
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { source_.fail_at(line_at_, what); }

  std::string_view take_word() {
    if (!text_.next_on_line()) return {};
    const std::string_view word = text_.peek_token();
    text_.skip_token();
    return word;
  }

  void read_format() {
    const std::string_view word = take_word();
    if (word == "ascii") {
      header_.encoding = PlyEncoding::ascii;
    } else if (word == "binary_little_endian") {
      header_.encoding = PlyEncoding::little_endian;
    } else if (word == "binary_big_endian") {
      header_.encoding = PlyEncoding::big_endian;
    } else {
      fail("unknown PLY format '" + printable(word) + "'");
    }
  }

  void read_element() {
    PlyElement element;
    element.name = take_word();
    std::int64_t count = -1;
    if (!text_.next_on_line() || !text_.read_integer(count) || count < 0) {
      fail("the count of the PLY element '" + printable(element.name) + "' is not a number");
    }
    element.count = static_cast<std::uint64_t>(count);
    header_.elements.push_back(std::move(element));
  }

  ValueType take_type() {
    const std::string_view word = take_word();
    const std::optional<ValueType> type = parse_type(word);
    if (!type) fail("unknown PLY type '" + printable(word) + "'");
    return *type;
  }

  void read_property() {
    if (header_.elements.empty()) fail("a PLY property before the first element");
    PlyProperty property;
    property.is_list = text_.next_on_line() && text_.peek_token() == "list";
    if (property.is_list) {
      text_.skip_token();
      property.count_type = take_type();
    }
    property.type = take_type();
    property.name = take_word();
    header_.elements.back().properties.push_back(std::move(property));
  }

  // The data may begin with a byte that looks like a part of the line end. So the line end is the
  // same as that of the first line; for files in which that is not so, LF, as most have.
  void end_header() {
    const std::string_view line_end = source_.bytes.substr(source_.bytes.find_first_of("\r\n"));
    if (line_end.starts_with('\r') && !line_end.starts_with("\r\n")) {
      header_.data_at = source_.bytes.find('\r', text_.position());
    } else {
      header_.data_at = source_.bytes.find('\n', text_.position());
    }
    const bool found = header_.data_at != std::string_view::npos;
    header_.data_at = found ? header_.data_at + 1 : source_.bytes.size();
  }

  const MeshSource& source_;
  TextScanner text_;
  PlyHeader header_;
  std::size_t line_at_ = 0;
};

}  // namespace

PlyHeader read_ply_header(const MeshSource& source) { return PlyHeaderReader(source).run(); }

}  // namespace meshrepair
