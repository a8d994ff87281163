// SPDX-License-Identifier: MIT
// Walks over the values in the body of a PLY file. The two kinds of body have cursors with the same
// functions, so that the reader is written once:
//
//   more()        whether there is another item
//   read(t, v)    the next value of the item; false if there is none
//   room(t)       more values of the type than this cannot follow
//   skip(t, n)    passes over n values; false if there are not so many
//   garbage()     a value of the item was no number
//   end_item()    the item has been read, or given up
//   kCanResume    whether the next item can be found after one that could not be read
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

#include <base/byte_order.h>
#include <mesh/mesh_source.h>

#include "formats/common/text_scanner.h"
#include "ply_header.h"

namespace meshrepair {

template <std::endian Order>
class PlyBinaryCursor {
 public:
  static constexpr bool kCanResume = false;

  PlyBinaryCursor(std::string_view bytes, const PlyHeader& header)
      : at_(bytes.data() + header.data_at), end_(bytes.data() + bytes.size()) {}

  [[nodiscard]] bool more() const { return at_ != end_; }
  void begin_element(const PlyElement& /*element*/) {}
  void end_item() {}
  [[nodiscard]] bool garbage() const { return false; }
  [[nodiscard]] std::size_t remaining() const { return static_cast<std::size_t>(end_ - at_); }
  [[nodiscard]] std::size_t room(ValueType type) const { return remaining() / size_of(type); }

  bool skip(ValueType type, std::size_t count) {
    if (count > room(type)) return false;
    at_ += count * size_of(type);
    return true;
  }

  bool read(ValueType type, double& value) {
    const char* const bytes = at_;
    if (!skip(type, 1)) return false;
    value = value_at(type, bytes);
    return true;
  }

 private:
  static double value_at(ValueType type, const char* bytes) {
    switch (type) {
      case ValueType::int8:
        return load<std::int8_t>(bytes, Order);
      case ValueType::uint8:
        return load<std::uint8_t>(bytes, Order);
      case ValueType::int16:
        return load<std::int16_t>(bytes, Order);
      case ValueType::uint16:
        return load<std::uint16_t>(bytes, Order);
      case ValueType::int32:
        return load<std::int32_t>(bytes, Order);
      case ValueType::uint32:
        return load<std::uint32_t>(bytes, Order);
      case ValueType::int64:
        return static_cast<double>(load<std::int64_t>(bytes, Order));
      case ValueType::uint64:
        return static_cast<double>(load<std::uint64_t>(bytes, Order));
      case ValueType::float32:
        return load<float>(bytes, Order);
      case ValueType::float64:
        break;
    }
    return load<double>(bytes, Order);
  }

  const char* at_;
  const char* end_;
};

// One item on each line, as the format has it; what a line holds beyond its item is ignored. Only
// where a line holds several items (all on one line) line ends mean nothing.
class PlyTextCursor {
 public:
  static constexpr bool kCanResume = true;

  PlyTextCursor(std::string_view bytes, const PlyHeader& header) : text_(bytes) {
    text_.go_to(header.data_at);
  }

  bool more() { return text_.next_anywhere(); }
  [[nodiscard]] std::size_t remaining() const { return text_.remaining(); }
  [[nodiscard]] std::size_t room(ValueType /*type*/) const { return text_.remaining(); }

  // Told by the first element without lists, whose items have a known number of values.
  void begin_element(const PlyElement& element) {
    const auto is_list = [](const PlyProperty& property) { return property.is_list; };
    const auto& properties = element.properties;
    if (std::any_of(properties.begin(), properties.end(), is_list) || element.count < 2) return;
    if (text_.next_anywhere()) lines_count_ = text_.tokens_on_line() < 2 * properties.size();
  }

  [[nodiscard]] bool garbage() const { return garbage_; }

  void end_item() {
    garbage_ = false;
    if (lines_count_) text_.skip_line();
  }

  bool skip(ValueType type, std::size_t count) {
    double ignored = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (!read(type, ignored)) return false;
    }
    return true;
  }

  // A token that is no number is read as NaN.
  bool read(ValueType /*type*/, double& value) {
    if (!(lines_count_ ? text_.next_on_line() : text_.next_anywhere())) return false;
    if (!text_.read_real(value)) garbage_ = true;
    return true;
  }

 private:
  TextScanner text_;
  bool lines_count_ = true;
  bool garbage_ = false;
};

// False where the data end, or the length cannot be one.
template <class Cursor>
bool read_length(Cursor& cursor, const PlyProperty& list, std::size_t& length) {
  double value = 0;
  if (!cursor.read(list.count_type, value)) return false;
  if (!(value >= 0 && value <= static_cast<double>(cursor.room(list.type)))) return false;
  length = static_cast<std::size_t>(value);
  return true;
}

template <class Cursor>
bool pass_over_property(Cursor& cursor, const PlyProperty& property) {
  std::size_t count = 1;
  return (!property.is_list || read_length(cursor, property, count)) &&
         cursor.skip(property.type, count);
}

}  // namespace meshrepair
