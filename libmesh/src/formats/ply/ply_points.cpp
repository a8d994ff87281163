// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <utility>

#include <base/error.h>
#include <mesh/read_guard.h>

#include "formats/common/point_columns.h"
#include "ply_cursor.h"
#include "ply_header.h"
#include "ply_io.h"

namespace meshrepair {
namespace {

// What a vertex may have that means something to us, and where in `values` it goes.
constexpr std::array<std::string_view, 9> kNames = {"x",  "y",   "z",     "nx",  "ny",
                                                    "nz", "red", "green", "blue"};
constexpr std::size_t kNowhere = kNames.size();

using Values = std::array<double, kNames.size() + 1>;  // and one for what means nothing

template <class Cursor>
class PlyPoints {
 public:
  PlyPoints(const MeshSource& source, const PlyHeader& header, const PointReadOptions& options)
      : source_(source),
        header_(header),
        options_(options),
        cursor_(source.bytes, header),
        guard_(source) {}

  PointReadResult run() {
    for (const PlyElement& element : header_.elements) {
      if (element.properties.empty()) continue;
      cursor_.begin_element(element);
      if (element.name == "vertex") {
        read_points(element);
        return std::move(result_);
      }
      if (!pass_over(element)) break;
    }
    source_.fail("the PLY file has no vertices that can be read");
  }

 private:
  bool pass_over(const PlyElement& element) {
    for (std::size_t item = 0; item < element.count && cursor_.more(); ++item) {
      guard_.step(0, source_.bytes.size() - cursor_.remaining());
      const bool whole = std::all_of(
          element.properties.begin(), element.properties.end(),
          [&](const PlyProperty& property) { return pass_over_property(cursor_, property); });
      if (!whole && !Cursor::kCanResume) return false;
      cursor_.end_item();
    }
    return true;
  }

  void find_places(const PlyElement& element) {
    std::array<bool, kNames.size()> there = {};
    for (const PlyProperty& property : element.properties) {
      const auto name = std::find(kNames.begin(), kNames.end(), property.name);
      const auto place = static_cast<std::size_t>(name - kNames.begin());
      places_.push_back(property.is_list || place == kNowhere || there[place] ? kNowhere : place);
      if (places_.back() != kNowhere) there[place] = true;
      if (place == 6 && property.type >= ValueType::float32) colour_scale_ = 255;  // 0 to 1
    }
    if (!there[0] || !there[1] || !there[2]) {
      source_.fail("the vertices of the PLY file have no x, y and z");
    }
    result_.report.normals = there[3] && there[4] && there[5];
    result_.report.colours = there[6] && there[7] && there[8];
  }

  void read_points(const PlyElement& element) {
    find_places(element);
    PointReadReport& report = result_.report;
    report.declared_points = element.count;
    std::size_t items = 0;
    for (; items < element.count && cursor_.more(); ++items) {
      guard_.step(0, source_.bytes.size() - cursor_.remaining());
      Values values = {};
      const bool whole = read_item(element, values);
      if (!whole && !Cursor::kCanResume) break;
      if (whole && !cursor_.garbage()) {
        take(values);
      } else {
        ++report.bad_points;
      }
      cursor_.end_item();
    }
    report.missing_points = element.count - items;
    warn();
  }

  bool read_item(const PlyElement& element, Values& values) {
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      const bool read = property.is_list ? pass_over_property(cursor_, property)
                                         : cursor_.read(property.type, values[places_[i]]);
      if (!read) return false;
    }
    return true;
  }

  void take(const Values& values) {
    PointCloud& cloud = result_.cloud;
    cloud.points.emplace_back(values[0], values[1], values[2]);
    if (result_.report.normals && options_.normals) {
      cloud.normals.emplace_back(values[3], values[4], values[5]);
    }
    if (result_.report.colours && options_.colours) {
      cloud.colours.push_back({to_colour(colour_scale_ * values[6]),
                               to_colour(colour_scale_ * values[7]),
                               to_colour(colour_scale_ * values[8])});
    }
  }

  void warn() {
    PointReadReport& report = result_.report;
    if (report.bad_points > 0) {
      report.warnings.push_back(
          {WarningCode::points_unreadable,
           counted(report.bad_points, "point") +
               " left out: cut, or coordinates that are missing or not numbers",
           {{"points", report.bad_points}}});
    }
    if (report.missing_points > 0) {
      report.warnings.push_back(cut_off("the header", report.declared_points, "point",
                                        report.declared_points - report.missing_points));
    }
  }

  const MeshSource& source_;
  const PlyHeader& header_;
  const PointReadOptions& options_;
  Cursor cursor_;
  ReadGuard guard_;
  std::vector<std::size_t> places_;  // of each property
  double colour_scale_ = 1;
  PointReadResult result_;
};

template <class Cursor>
PointReadResult read_body(const MeshSource& source, const PlyHeader& header,
                          const PointReadOptions& options) {
  return PlyPoints<Cursor>(source, header, options).run();
}

}  // namespace

bool is_ply_of_points(const MeshSource& source) {
  if (!begins_with_ply(source.bytes)) return false;
  try {
    const PlyHeader header = read_ply_header(source);
    bool any_points = false;
    for (const PlyElement& element : header.elements) {
      if ((element.name == "face" || element.name == "tristrips") && element.count > 0)
        return false;
      any_points |= element.name == "vertex" && element.count > 0;
    }
    return any_points;
  } catch (const InputError&) {
    return false;
  }
}

PointReadResult read_ply_points(const MeshSource& source, const PointReadOptions& options) {
  const PlyHeader header = read_ply_header(source);
  PointReadResult result;
  switch (header.encoding) {
    case PlyEncoding::ascii:
      result = read_body<PlyTextCursor>(source, header, options);
      break;
    case PlyEncoding::little_endian:
      result = read_body<PlyBinaryCursor<std::endian::little>>(source, header, options);
      break;
    case PlyEncoding::big_endian:
      result = read_body<PlyBinaryCursor<std::endian::big>>(source, header, options);
      break;
  }
  result.report.format =
      header.encoding == PlyEncoding::ascii ? PointFormat::ply_ascii : PointFormat::ply_binary;
  return result;
}

}  // namespace meshrepair
