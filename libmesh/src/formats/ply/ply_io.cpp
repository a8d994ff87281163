// SPDX-License-Identifier: MIT
#include "ply_io.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <string>

#include <mesh/read_guard.h>

#include "formats/common/face_list.h"
#include "ply_attributes.h"
#include "ply_cursor.h"
#include "ply_header.h"

namespace meshrepair {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kMostElementsTold = 8;
constexpr std::size_t kNoProperty = std::numeric_limits<std::size_t>::max();

std::size_t find_property(const PlyElement& element, std::string_view name, bool is_list) {
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const PlyProperty& property = element.properties[i];
    if (property.is_list == is_list && property.name == name) return i;
  }
  return kNoProperty;
}

// The property that holds the corners of a face or the points of a strip.
std::size_t find_indices(const PlyElement& element) {
  for (const std::string_view name : {"vertex_indices", "vertex_index"}) {
    const std::size_t found = find_property(element, name, true);
    if (found != kNoProperty) return found;
  }
  const auto is_list = [](const PlyProperty& property) { return property.is_list; };
  const auto& all = element.properties;
  if (std::count_if(all.begin(), all.end(), is_list) != 1) return kNoProperty;
  return static_cast<std::size_t>(std::find_if(all.begin(), all.end(), is_list) - all.begin());
}

std::int64_t to_index(double value) {
  constexpr double kLargest = std::numeric_limits<std::uint32_t>::max();
  if (!(value >= 0 && value <= kLargest) || value != std::floor(value)) return FaceList::kNoPoint;
  return static_cast<std::int64_t>(value);
}

template <class Cursor>
class PlyBody {
 public:
  PlyBody(const MeshSource& source, const PlyHeader& header, SoupFormat format)
      : source_(source), header_(header), cursor_(source.bytes, header), guard_(source) {
    result_.report.format = format;
    if (source.options.attributes) attributes_.emplace(source, header);
  }

  ReadResult run() {
    for (const PlyElement& element : header_.elements) {
      if (element.properties.empty()) continue;
      cursor_.begin_element(element);
      if (attributes_) attributes_->begin_element(element);
      if (element.name == "vertex") {
        read_points(element);
      } else if (element.name == "face") {
        read_faces(element);
      } else if (element.name == "tristrips") {
        read_strips(element);
      } else {
        const std::size_t items = read_items(element, [&] { return pass_over(element); });
        if (items > 0 && left_out_.size() < kMostElementsTold) left_out_.insert(element.name);
      }
    }
    guard_.step(faces_.triangles(), source_.bytes.size());
    report_losses();
    warn_of_left_out();
    if (attributes_) {
      std::vector<FaceList::Origin> origins;
      faces_.append_to(result_, source_.options.progress, &origins);
      result_.attributes = attributes_->take(origins, result_.soup.triangles, !has_strips_);
    } else {
      faces_.append_to(result_, source_.options.progress);
    }
    return std::move(result_);
  }

 private:
  // Calls read_item, which returns whether the item could be read in full, for every item that the
  // file has. Returns how many there were.
  template <class ReadItem>
  std::size_t read_items(const PlyElement& element, const ReadItem& read_item) {
    std::size_t items = 0;
    for (; items < element.count && !stopped_ && cursor_.more(); ++items) {
      const Cursor start = cursor_;
      guard_.step(faces_.triangles(), source_.bytes.size() - cursor_.remaining());
      stopped_ = !read_item() && !Cursor::kCanResume;
      if (stopped_) {
        cursor_ = start;
        break;
      }
      cursor_.end_item();
    }
    if (items < element.count) {
      result_.report.warnings.push_back({WarningCode::file_cut_off,
                                         "the header promises " + std::to_string(element.count) +
                                             " of the element " + printable(element.name) +
                                             ", the file holds " + std::to_string(items),
                                         {{"promised", element.count}, {"found", items}}});
    }
    return items;
  }

  void warn_of_left_out() {
    std::string names;
    for (const std::string& name : left_out_) {
      names += (names.empty() ? "" : ", ") + printable(name);
    }
    if (names.empty()) return;
    result_.report.warnings.push_back(
        {WarningCode::content_ignored, "what is not known here is left out: " + names});
  }

  bool pass_over(const PlyElement& element) {
    return std::all_of(
        element.properties.begin(), element.properties.end(),
        [&](const PlyProperty& property) { return pass_over_property(cursor_, property); });
  }

  // But for what it says of attributes, if these are wanted.
  bool pass_over(const PlyProperty& property, std::size_t number) {
    if (!attributes_) return pass_over_property(cursor_, property);
    std::size_t length = 1;
    if (property.is_list && !read_length(cursor_, property, length)) return false;
    for (double value = 0; length > 0; --length) {
      if (!cursor_.read(property.type, value)) return false;
      attributes_->add(number, value);
    }
    return true;
  }

  void read_points(const PlyElement& element) {
    std::vector<int> axes(element.properties.size(), -1);
    for (int axis = 0; axis < 3; ++axis) {
      const std::array<std::string_view, 3> names = {"x", "y", "z"};
      const std::size_t found =
          find_property(element, names[static_cast<std::size_t>(axis)], false);
      if (found == kNoProperty) source_.fail("the vertices of the PLY file have no x, y and z");
      axes[found] = axis;
    }
    // Three numbers take at least three bytes.
    result_.soup.points.reserve(within(element.count, cursor_.remaining() / 3 + 1));
    read_items(element, [&] { return read_point(element, axes); });
  }

  bool read_point(const PlyElement& element, const std::vector<int>& axes) {
    Vec3d point = Vec3d::Constant(kNaN);
    bool whole = true;
    for (std::size_t i = 0; i < axes.size() && whole; ++i) {
      const PlyProperty& property = element.properties[i];
      whole = axes[i] < 0 ? pass_over(property, i) : cursor_.read(property.type, point[axes[i]]);
    }
    if (!whole && !Cursor::kCanResume) return false;
    if (attributes_) attributes_->end_point();
    if ((!whole || cursor_.garbage()) && !point.allFinite()) ++result_.report.bad_points;
    result_.soup.points.push_back(point);
    return whole;
  }

  // Reads an item whose property number `wanted` is a list, and calls take(value) for each of its
  // values.
  template <class Take>
  bool read_list_item(const PlyElement& element, std::size_t wanted, const Take& take) {
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      if (i != wanted) {
        if (!pass_over(property, i)) return false;
        continue;
      }
      std::size_t length = 0;
      if (!read_length(cursor_, property, length)) return false;
      for (double value = 0; length > 0; --length) {
        if (!cursor_.read(property.type, value)) return false;
        take(value);
      }
    }
    return true;
  }

  void read_faces(const PlyElement& element) {
    const std::size_t indices = find_indices(element);
    if (indices == kNoProperty) source_.fail("the faces of the PLY file have no vertex_indices");
    std::size_t unreadable = 0;
    bool ends_file = false;
    const std::size_t found = read_items(element, [&] {
      faces_.begin_face();
      const auto add = [&](double value) { faces_.add_corner(to_index(value)); };
      const bool whole = read_list_item(element, indices, add);
      ends_file = whole && cursor_.remaining() == 0;
      if (whole) {
        end_face();
      } else {
        faces_.drop_face();
        if (attributes_) attributes_->forget_item();
        ++unreadable;
      }
      return whole;
    });
    result_.report.declared_triangles += element.count;
    result_.report.missing_faces += element.count - found;
    if (!Cursor::kCanResume) return;
    // The last number of a cut text may be cut too.
    if (ends_file && found < element.count) {
      faces_.drop_face();
      if (attributes_) attributes_->drop_face(faces_.corners());
      ++unreadable;
    }
    report_unreadable(unreadable);
  }

  void end_face() {
    const std::size_t before = corners_;
    faces_.end_face();
    corners_ = faces_.corners();
    if (attributes_) attributes_->end_face(corners_ - before);
  }

  void report_unreadable(std::size_t count) {
    if (count == 0) return;
    result_.report.bad_faces += count;
    result_.report.warnings.push_back(
        {WarningCode::faces_unreadable,
         counted(count, "face") + " left out: cut, or a list longer than its line",
         {{"faces", count}}});
  }

  // Every value after the second of a strip makes a triangle with the two before; every other one
  // of these is turned round. A negative value ends the strip and begins another.
  void read_strips(const PlyElement& element) {
    const std::size_t indices = find_indices(element);
    has_strips_ = true;
    if (indices == kNoProperty) source_.fail("the strips of the PLY file have no vertex_indices");
    read_items(element, [&] {
      std::array<std::int64_t, 2> before = {};
      std::size_t length = 0;
      return read_list_item(element, indices, [&](double value) {
        if (value < 0) {
          length = 0;
          return;
        }
        const std::int64_t index = to_index(value);
        if (length >= 2) add_strip_triangle(before, index, length % 2 == 1);
        before = {before[1], index};
        ++length;
      });
    });
  }

  void add_strip_triangle(const std::array<std::int64_t, 2>& before, std::int64_t index,
                          bool turned) {
    faces_.begin_face();
    faces_.add_corner(before[turned ? 1 : 0]);
    faces_.add_corner(before[turned ? 0 : 1]);
    faces_.add_corner(index);
    faces_.end_face();
  }

  void report_losses() {
    ReadReport& report = result_.report;
    if (cursor_.more()) report.trailing_bytes = cursor_.remaining();
    if (report.trailing_bytes > 0) {
      report.warnings.push_back(
          bytes_ignored(report.trailing_bytes, "after the last whole element"));
    }
    if (report.bad_points > 0) {
      report.warnings.push_back(
          {WarningCode::points_unreadable,
           "coordinates of " + counted(report.bad_points, "point") + " are missing or not numbers",
           {{"points", report.bad_points}}});
    }
  }

  const MeshSource& source_;
  const PlyHeader& header_;
  Cursor cursor_;
  ReadResult result_;
  FaceList faces_;
  ReadGuard guard_;
  std::optional<PlyAttributes> attributes_;  // if they are wanted
  std::size_t corners_ = 0;                  // of faces that have ended
  bool has_strips_ = false;
  std::set<std::string> left_out_;  // elements
  bool stopped_ = false;            // what follows cannot be read
};

}  // namespace

bool begins_with_ply(std::string_view bytes) {
  TextScanner text(bytes);
  if (!bytes.starts_with("ply")) return false;
  text.skip_token();
  return text.position() == 3 && !text.next_on_line() && text.remaining() > 0;
}

ReadResult read_ply(const MeshSource& source) {
  const PlyHeader header = read_ply_header(source);
  switch (header.encoding) {
    case PlyEncoding::ascii:
      return PlyBody<PlyTextCursor>(source, header, SoupFormat::ply_ascii).run();
    case PlyEncoding::little_endian:
      return PlyBody<PlyBinaryCursor<std::endian::little>>(source, header, SoupFormat::ply_binary)
          .run();
    case PlyEncoding::big_endian:
      break;
  }
  return PlyBody<PlyBinaryCursor<std::endian::big>>(source, header, SoupFormat::ply_binary).run();
}

}  // namespace meshrepair
