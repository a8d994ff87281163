// SPDX-License-Identifier: MIT
#include "pcd_points.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include <base/byte_order.h>
#include <mesh/read_guard.h>

#include "formats/common/text_scanner.h"
#include "lzf.h"
#include "pcd_header.h"

namespace meshrepair {
namespace {

double value_at(ValueType type, const char* bytes) {
  constexpr std::endian kOrder = std::endian::little;
  switch (type) {
    case ValueType::int8:
      return load<std::int8_t>(bytes, kOrder);
    case ValueType::uint8:
      return load<std::uint8_t>(bytes, kOrder);
    case ValueType::int16:
      return load<std::int16_t>(bytes, kOrder);
    case ValueType::uint16:
      return load<std::uint16_t>(bytes, kOrder);
    case ValueType::int32:
      return load<std::int32_t>(bytes, kOrder);
    case ValueType::uint32:
      return load<std::uint32_t>(bytes, kOrder);
    case ValueType::int64:
      return static_cast<double>(load<std::int64_t>(bytes, kOrder));
    case ValueType::uint64:
      return static_cast<double>(load<std::uint64_t>(bytes, kOrder));
    case ValueType::float32:
      return load<float>(bytes, kOrder);
    case ValueType::float64:
      break;
  }
  return load<double>(bytes, kOrder);
}

class PcdReader {
 public:
  PcdReader(const MeshSource& source, const PointReadOptions& options)
      : source_(source), options_(options), header_(read_pcd_header(source)), guard_(source) {
    position_ = {find("x"), find("y"), find("z")};
    normal_ = {find("normal_x"), find("normal_y"), find("normal_z")};
    const auto is_there = [](const PcdField* field) { return field != nullptr; };
    if (!std::all_of(position_.begin(), position_.end(), is_there)) {
      source_.fail("the points of the PCD file have no x, y and z");
    }
    colour_ = find("rgb") != nullptr ? find("rgb") : find("rgba");
    if (colour_ != nullptr && colour_->size != 4) colour_ = nullptr;
    result_.report.normals = std::all_of(normal_.begin(), normal_.end(), is_there);
    result_.report.colours = colour_ != nullptr;
    result_.report.declared_points = header_.points;
  }

  PointReadResult run() {
    switch (header_.encoding) {
      case PcdEncoding::ascii:
        result_.report.format = PointFormat::pcd_ascii;
        read_lines();
        break;
      case PcdEncoding::binary:
        result_.report.format = PointFormat::pcd_binary;
        read_records();
        break;
      case PcdEncoding::compressed:
        result_.report.format = PointFormat::pcd_compressed;
        read_compressed();
        break;
    }
    warn();
    return std::move(result_);
  }

 private:
  [[nodiscard]] const PcdField* find(std::string_view name) const {
    for (const PcdField& field : header_.fields) {
      if (field.name == name && field.count > 0) return &field;
    }
    return nullptr;
  }

  // `value(field)` is the first value of a field of the point, `packed()` the bits of its colour.
  template <class Value, class Packed>
  void take(const Value& value, const Packed& packed) {
    PointCloud& cloud = result_.cloud;
    cloud.points.emplace_back(value(*position_[0]), value(*position_[1]), value(*position_[2]));
    if (result_.report.normals && options_.normals) {
      cloud.normals.emplace_back(value(*normal_[0]), value(*normal_[1]), value(*normal_[2]));
    }
    if (colour_ != nullptr && options_.colours) {
      const std::uint32_t bits = packed();
      cloud.colours.push_back({static_cast<std::uint8_t>(bits >> 16),
                               static_cast<std::uint8_t>(bits >> 8),
                               static_cast<std::uint8_t>(bits)});
    }
  }

  // `place(field)` is where the field's first value of the point is.
  template <class Place>
  void take_bytes(const Place& place) {
    take([&](const PcdField& field) { return value_at(field.type, place(field)); },
         [&] { return load<std::uint32_t>(place(*colour_), std::endian::little); });
  }

  void read_records() {
    const std::string_view data = source_.bytes.substr(header_.data_at);
    const std::size_t count = within(header_.points, data.size() / header_.record);
    for (std::size_t i = 0; i < count; ++i) {
      guard_.step(0, header_.data_at + i * header_.record);
      const char* const record = data.data() + i * header_.record;
      take_bytes([&](const PcdField& field) { return record + field.at; });
    }
    result_.report.missing_points = header_.points - count;
    result_.report.trailing_bytes =
        count == header_.points ? data.size() - count * header_.record : 0;
  }

  void read_compressed() {
    constexpr std::size_t kSizes = 8;
    const std::string_view data = source_.bytes.substr(header_.data_at);
    if (data.size() < kSizes) source_.fail("the compressed points of the PCD file are cut");
    const std::size_t packed_size = load<std::uint32_t>(data.data(), std::endian::little);
    const std::size_t size = load<std::uint32_t>(data.data() + 4, std::endian::little);
    if (packed_size > data.size() - kSizes) {
      source_.fail("the compressed points of the PCD file are cut");
    }
    if (size % header_.record != 0 || size / header_.record != header_.points) {
      source_.fail("the compressed points of the PCD file are not as many as its header says");
    }
    const std::optional<std::string> bytes = expand_lzf(data.substr(kSizes, packed_size), size);
    if (!bytes) source_.fail("the compressed points of the PCD file are damaged");
    const std::size_t count = size / header_.record;
    for (std::size_t i = 0; i < count; ++i) {
      guard_.step(0, source_.bytes.size());
      // The fields that stand before this one have all their values before.
      take_bytes([&](const PcdField& field) {
        return bytes->data() + field.at * count + i * field.bytes();
      });
    }
    result_.report.trailing_bytes = data.size() - kSizes - packed_size;
  }

  void read_lines() {
    TextScanner text(source_.bytes);
    text.go_to(header_.data_at);
    std::size_t lines = 0;
    std::vector<double> values(header_.fields.size());
    for (; lines < header_.points && text.next_anywhere(); ++lines) {
      guard_.step(0, text.position());
      if (read_values(text, values)) {
        take([&](const PcdField& field) { return values[index_of(field)]; },
             [&] { return packed_colour(values[index_of(*colour_)]); });
      } else {
        ++result_.report.bad_points;
      }
      text.skip_line();
    }
    result_.report.missing_points = header_.points - lines;
  }

  [[nodiscard]] std::size_t index_of(const PcdField& field) const {
    return static_cast<std::size_t>(&field - header_.fields.data());
  }

  // The first value of each field.
  bool read_values(TextScanner& text, std::vector<double>& values) const {
    for (const PcdField& field : header_.fields) {
      for (std::size_t i = 0; i < field.count; ++i) {
        double value = 0;
        if (!text.next_on_line() || !text.read_real(value)) return false;
        if (i == 0) values[index_of(field)] = value;
      }
    }
    return true;
  }

  // As text, a colour is an integer, with a sign or without, or the float whose bits it has.
  [[nodiscard]] std::uint32_t packed_colour(double value) const {
    constexpr double kLeast = std::numeric_limits<std::int32_t>::min();
    constexpr double kMost = std::numeric_limits<std::uint32_t>::max();
    if (colour_->type == ValueType::float32)
      return std::bit_cast<std::uint32_t>(static_cast<float>(value));
    const bool is_one = value >= kLeast && value <= kMost;
    return is_one ? static_cast<std::uint32_t>(static_cast<std::int64_t>(value)) : 0;
  }

  void warn() {
    PointReadReport& report = result_.report;
    if (report.bad_points > 0) {
      report.warnings.push_back(
          {WarningCode::points_unreadable,
           counted(report.bad_points, "line") + " left out: cut, or values that are not numbers",
           {{"points", report.bad_points}}});
    }
    if (report.missing_points > 0) {
      report.warnings.push_back(cut_off("the header", report.declared_points, "point",
                                        report.declared_points - report.missing_points));
    }
    if (report.trailing_bytes > 0) {
      report.warnings.push_back(bytes_ignored(report.trailing_bytes, "after the last point"));
    }
  }

  const MeshSource& source_;
  const PointReadOptions& options_;
  PcdHeader header_;
  ReadGuard guard_;
  std::array<const PcdField*, 3> position_ = {};
  std::array<const PcdField*, 3> normal_ = {};
  const PcdField* colour_ = nullptr;
  PointReadResult result_;
};

}  // namespace

bool begins_with_pcd(std::string_view bytes) {
  if (bytes.starts_with("# .PCD")) return true;
  TextScanner text(bytes.substr(0, 4096), {.comment = '#'});
  if (!text.next_anywhere()) return false;
  const std::string_view word = text.peek_token();
  return word == "VERSION" || word == "FIELDS" || word == "COLUMNS";
}

PointReadResult read_pcd_points(const MeshSource& source, const PointReadOptions& options) {
  return PcdReader(source, options).run();
}

}  // namespace meshrepair
