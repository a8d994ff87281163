// SPDX-License-Identifier: MIT
#include "obj_attributes.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <base/ids.h>

#include "formats/common/text_writer.h"

namespace meshrepair {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

constexpr std::int64_t kNoValue = std::numeric_limits<std::int64_t>::min();

// The number at the start of `text`, which goes on behind it and the slash that follows.
std::optional<std::int64_t> next_index(std::string_view& text) {
  std::int64_t number = 0;
  const char* const begin = text.data();
  const auto [end, error] = std::from_chars(begin, begin + text.size(), number);
  // Beyond all numbers there is none either that a file has.
  if (error == std::errc::result_out_of_range) number = std::numeric_limits<std::int64_t>::max();
  const bool any = end != begin;
  text.remove_prefix(static_cast<std::size_t>(end - begin));
  text.remove_prefix(std::min(
      text.size(), text.find('/') == std::string_view::npos ? text.size() : text.find('/') + 1));
  return any ? std::optional(number) : std::nullopt;
}

std::int64_t position_of(std::optional<std::int64_t> index, std::size_t count) {
  if (!index) return kNoValue;
  if (*index >= 0) return *index - 1;
  return std::max<std::int64_t>(static_cast<std::int64_t>(count) + *index, -1);
}

void append_values(std::string& text, std::string_view word, const CornerAttribute* attribute) {
  if (attribute == nullptr) return;
  append_lines(text, attribute->count(), [&](std::string& lines, std::size_t i) {
    lines += word;
    for (std::size_t k = 0; k < attribute->components; ++k) {
      lines += ' ';
      append_number(lines, attribute->values[attribute->components * i + k]);
    }
    lines += '\n';
  });
}

void append_points(std::string& text, const TriangleSoup& soup, const CornerAttribute* colours) {
  std::vector<std::uint32_t> colour_of;
  if (colours != nullptr) colour_of = first_values_by_point(soup, *colours);
  append_lines(text, soup.points.size(), [&](std::string& lines, std::size_t p) {
    lines += "v ";
    append_triple(lines, soup.points[p]);
    if (!colour_of.empty() && colour_of[p] != kNone) {
      lines += ' ';
      append_triple(lines, colours->values.data() + colours->components * colour_of[p]);
    }
    lines += '\n';
  });
}

// Lines that say which label holds from here on.
class LabelLines {
 public:
  LabelLines(std::string_view word, std::string_view none, const TriangleLabels& labels)
      : word_(word), none_(none), labels_(labels) {}

  void append_change(std::string& text, std::size_t t) {
    if (labels_.empty()) return;
    const std::uint32_t label = labels_.of_triangle[t];
    if (label == current_) return;
    current_ = label;
    text += word_;
    if (label != kNone || !none_.empty()) text += ' ';
    text += label == kNone ? none_ : std::string_view(labels_.names[label]);
    text += '\n';
  }

 private:
  std::string_view word_, none_;
  const TriangleLabels& labels_;
  std::uint32_t current_ = kNone;
};

// "/3/9", "/3", "//9", or nothing.
void append_corner(std::string& text, std::size_t corner, const CornerAttribute* texture,
                   const CornerAttribute* normal) {
  const auto index = [&](const CornerAttribute* attribute) {
    return attribute == nullptr ? kNone : attribute->of_corner[corner];
  };
  const std::uint32_t t = index(texture), n = index(normal);
  if (t == kNone && n == kNone) return;
  text += '/';
  if (t != kNone) append_number(text, std::uint64_t{t} + 1);
  if (n == kNone) return;
  text += '/';
  append_number(text, std::uint64_t{n} + 1);
}

}  // namespace

void append_obj(std::string& text, const TriangleSoup& soup, const Attributes& attributes) {
  using Kind = CornerAttribute::Kind;
  const CornerAttribute* const texture = find_kind(attributes, Kind::texture);
  const CornerAttribute* const normal = find_kind(attributes, Kind::normal);
  append_points(text, soup, find_kind(attributes, Kind::colour));
  append_values(text, "vt", texture);
  append_values(text, "vn", normal);
  std::array<LabelLines, 4> labels = {
      LabelLines("o", "", attributes.objects), LabelLines("g", "", attributes.groups),
      LabelLines("usemtl", "", attributes.materials), LabelLines("s", "off", attributes.smoothing)};
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    for (LabelLines& lines : labels) lines.append_change(text, t);
    text += 'f';
    for (std::size_t k = 0; k < 3; ++k) {
      text += ' ';
      append_number(text, std::uint64_t{soup.triangles[t][k]} + 1);
      append_corner(text, 3 * t + k, texture, normal);
    }
    text += '\n';
  }
}

// Without a name none holds from here on.
void ObjAttributes::Labels::choose(std::string_view name) {
  if (name.empty()) {
    current = kNone;
    return;
  }
  const auto fresh = static_cast<std::uint32_t>(labels.names.size());
  const auto [found, is_new] = number.try_emplace(std::string(name), fresh);
  if (is_new) labels.names.emplace_back(name);
  current = found->second;
}

TriangleLabels ObjAttributes::Labels::take(const std::vector<FaceList::Origin>& origins) {
  if (labels.names.empty()) return {};
  TriangleLabels taken{std::move(labels.names), {}};
  taken.of_triangle.reserve(origins.size());
  for (const FaceList::Origin& origin : origins) {
    taken.of_triangle.push_back(labels.of_triangle[origin.face]);
  }
  return taken;
}

void ObjAttributes::Corners::add(TextScanner& text, std::size_t most) {
  std::array<double, 3> value{};
  std::size_t count = 0;
  while (count < most && text.next_on_line()) (void)text.read_real(value[count++]);
  // A file has as many numbers in each line; of one that has not, the first line decides.
  if (components == 0) components = std::max<std::size_t>(count, 2);
  values.insert(values.end(), value.begin(),
                value.begin() + static_cast<std::ptrdiff_t>(components));
}

CornerAttribute ObjAttributes::Corners::take(CornerAttribute::Kind kind,
                                             const std::vector<FaceList::Origin>& origins) {
  CornerAttribute taken;
  taken.kind = kind;
  taken.components = components;
  taken.values = std::move(values);
  const auto count = static_cast<std::int64_t>(taken.count());
  taken.of_corner.reserve(3 * origins.size());
  for (const FaceList::Origin& origin : origins) {
    for (const std::size_t corner : origin.corners) {
      const std::int64_t value = of_corner[corner];
      const bool is_there = value >= 0 && value < count;
      if (!is_there && value != kNoValue) ++bad;
      taken.of_corner.push_back(is_there ? static_cast<std::uint32_t>(value) : kNone);
    }
  }
  return taken;
}

void ObjAttributes::Corners::count_bad(const std::vector<FaceList::Origin>& origins) {
  for (const FaceList::Origin& origin : origins) {
    bad += static_cast<std::size_t>(
        std::count_if(origin.corners.begin(), origin.corners.end(),
                      [&](std::size_t corner) { return of_corner[corner] != kNoValue; }));
  }
}

bool ObjAttributes::read_line(std::string_view word, TextScanner& text) {
  if (word == "vt") {
    texture_.add(text, 3);
  } else if (word == "vn") {
    normals_.components = 3;
    normals_.add(text, 3);
  } else if (word == "usemtl") {
    materials_.choose(text.rest_of_line());
  } else if (word == "g") {
    groups_.choose(text.rest_of_line());
  } else if (word == "o") {
    objects_.choose(text.rest_of_line());
  } else if (word == "s") {
    smoothing_.choose(text.rest_of_line());
  } else if (word == "mtllib") {
    libraries_.emplace_back(text.rest_of_line());
  } else {
    return false;
  }
  return true;
}

void ObjAttributes::read_colour(TextScanner& text, std::size_t points) {
  std::array<double, 3> colour = {kNothing, kNothing, kNothing};
  std::size_t count = 0;
  while (count < 3 && text.next_on_line()) {
    if (!text.read_real(colour[count])) break;
    ++count;
  }
  if (count < 3) return;
  colours_.resize(3 * (points - 1), kNothing);
  colours_.insert(colours_.end(), colour.begin(), colour.end());
}

void ObjAttributes::add_corner(std::string_view token) {
  (void)next_index(token);
  const std::size_t textures =
      texture_.components == 0 ? 0 : texture_.values.size() / texture_.components;
  texture_.of_corner.push_back(position_of(next_index(token), textures));
  normals_.of_corner.push_back(position_of(next_index(token), normals_.values.size() / 3));
}

void ObjAttributes::keep_corners(std::size_t corners) {
  texture_.of_corner.resize(corners);
  normals_.of_corner.resize(corners);
}

void ObjAttributes::end_face() {
  for (Labels* labels : {&materials_, &groups_, &objects_, &smoothing_}) {
    labels->labels.of_triangle.push_back(labels->current);
  }
}

Attributes ObjAttributes::take(const std::vector<FaceList::Origin>& origins,
                               const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  using Kind = CornerAttribute::Kind;
  Attributes attributes;
  if (texture_.values.empty()) {
    texture_.count_bad(origins);
  } else {
    attributes.corners.push_back(texture_.take(Kind::texture, origins));
  }
  if (normals_.values.empty()) {
    normals_.count_bad(origins);
  } else {
    attributes.corners.push_back(normals_.take(Kind::normal, origins));
  }
  if (!colours_.empty()) {
    CornerAttribute colours;
    colours.kind = Kind::colour;
    colours.place = CornerAttribute::Place::point;
    colours.components = 3;
    colours.values = std::move(colours_);
    for (const auto& triangle : triangles) {
      for (const std::uint32_t p : triangle) {
        const bool has_one = p < colours.count() && !std::isnan(colours.values[3 * p]);
        colours.of_corner.push_back(has_one ? p : kNone);
      }
    }
    attributes.corners.push_back(std::move(colours));
  }
  attributes.materials = materials_.take(origins);
  attributes.groups = groups_.take(origins);
  attributes.objects = objects_.take(origins);
  attributes.smoothing = smoothing_.take(origins);
  return attributes;
}

}  // namespace meshrepair
