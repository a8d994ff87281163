// SPDX-License-Identifier: MIT
#include "pcd_header.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "formats/common/text_scanner.h"

namespace meshrepair {
namespace {

// No field has more values, and no file more fields; products stay far below 2^63.
constexpr std::size_t kMostValues = 1u << 20;
constexpr std::size_t kMostFields = 4096;

std::optional<ValueType> type_of(char letter, std::size_t size) {
  switch (letter) {
    case 'F':
      if (size == 4) return ValueType::float32;
      if (size == 8) return ValueType::float64;
      return std::nullopt;
    case 'I':
      if (size == 1) return ValueType::int8;
      if (size == 2) return ValueType::int16;
      if (size == 4) return ValueType::int32;
      if (size == 8) return ValueType::int64;
      return std::nullopt;
    case 'U':
      if (size == 1) return ValueType::uint8;
      if (size == 2) return ValueType::uint16;
      if (size == 4) return ValueType::uint32;
      if (size == 8) return ValueType::uint64;
      return std::nullopt;
    default:
      return std::nullopt;
  }
}

class PcdHeaderReader {
 public:
  explicit PcdHeaderReader(const MeshSource& source)
      : source_(source), text_(source.bytes, {.comment = '#'}) {}

  PcdHeader run() {
    while (text_.next_anywhere()) {
      line_at_ = text_.position();
      const std::string_view word = text_.peek_token();
      text_.skip_token();
      if (word == "DATA") {
        read_encoding();
        text_.skip_line();
        header_.data_at = text_.position();
        finish();
        return std::move(header_);
      }
      read_entry(word);
      text_.skip_line();
    }
    source_.fail("the PCD header has no DATA");
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { source_.fail_at(line_at_, what); }

  void read_entry(std::string_view word) {
    if (word == "FIELDS" || word == "COLUMNS") {
      names_ = take_words();
    } else if (word == "SIZE") {
      sizes_ = take_numbers();
    } else if (word == "TYPE") {
      types_ = take_words();
    } else if (word == "COUNT") {
      counts_ = take_numbers();
    } else if (word == "WIDTH") {
      width_ = take_number();
    } else if (word == "HEIGHT") {
      height_ = take_number();
    } else if (word == "POINTS") {
      points_ = take_number();
    } else if (word != "VERSION" && word != "VIEWPOINT") {
      fail("unknown word '" + printable(word) + "' in the PCD header");
    }
  }

  std::vector<std::string> take_words() {
    std::vector<std::string> words;
    while (text_.next_on_line()) {
      if (words.size() == kMostFields) fail("too many fields in the PCD header");
      words.emplace_back(text_.peek_token());
      text_.skip_token();
    }
    return words;
  }

  std::uint64_t take_number() {
    std::int64_t value = -1;
    if (!text_.next_on_line() || !text_.read_integer(value) || value < 0) {
      fail("a number of the PCD header is none");
    }
    return static_cast<std::uint64_t>(value);
  }

  std::vector<std::size_t> take_numbers() {
    std::vector<std::size_t> numbers;
    while (text_.next_on_line()) {
      if (numbers.size() == kMostFields) fail("too many fields in the PCD header");
      const std::uint64_t number = take_number();
      if (number > kMostValues) fail("a field of the PCD header is too large");
      numbers.push_back(static_cast<std::size_t>(number));
    }
    return numbers;
  }

  void read_encoding() {
    const std::vector<std::string> words = take_words();
    const std::string word = words.empty() ? "" : words[0];
    if (word == "ascii") {
      header_.encoding = PcdEncoding::ascii;
    } else if (word == "binary") {
      header_.encoding = PcdEncoding::binary;
    } else if (word == "binary_compressed") {
      header_.encoding = PcdEncoding::compressed;
    } else {
      fail("unknown PCD data '" + printable(word) + "'");
    }
  }

  void finish() {
    if (names_.empty()) source_.fail("the PCD header names no FIELDS");
    if (counts_.empty()) counts_.assign(names_.size(), 1);
    if (sizes_.size() != names_.size() || types_.size() != names_.size() ||
        counts_.size() != names_.size()) {
      source_.fail(
          "FIELDS, SIZE, TYPE and COUNT of the PCD header have different numbers of entries");
    }
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const auto type = type_of(types_[i].empty() ? ' ' : types_[i][0], sizes_[i]);
      // Fields named "_" are padding, of any kind.
      if (!type && names_[i] != "_") {
        source_.fail("the PCD field '" + printable(names_[i]) + "' has an unknown type");
      }
      header_.fields.push_back(
          {names_[i], type.value_or(ValueType::uint8), sizes_[i], counts_[i], header_.record});
      header_.record += header_.fields.back().bytes();
    }
    if (header_.record == 0) source_.fail("the points of the PCD file are empty");
    header_.points = points_.value_or(saturated_product(width_.value_or(0), height_.value_or(1)));
  }

  static std::uint64_t saturated_product(std::uint64_t a, std::uint64_t b) {
    constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
    return b != 0 && a > kMost / b ? kMost : a * b;
  }

  const MeshSource& source_;
  TextScanner text_;
  PcdHeader header_;
  std::vector<std::string> names_, types_;
  std::vector<std::size_t> sizes_, counts_;
  std::optional<std::uint64_t> width_, height_, points_;
  std::size_t line_at_ = 0;
};

}  // namespace

PcdHeader read_pcd_header(const MeshSource& source) { return PcdHeaderReader(source).run(); }

}  // namespace meshrepair
