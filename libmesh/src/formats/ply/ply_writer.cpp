// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <base/assert.h>
#include <base/ids.h>
#include <mesh/attributes.h>
#include <mesh/named_files.h>

#include "formats/common/text_writer.h"
#include "ply_io.h"
#include "ply_names.h"

namespace meshrepair {
namespace {

using Kind = CornerAttribute::Kind;
using Place = CornerAttribute::Place;
using Storage = CornerAttribute::Storage;

static_assert(std::endian::native == std::endian::little, "numbers are copied as they are");

// One attribute, as properties of points or of faces.
struct PlyColumns {
  const CornerAttribute* attribute = nullptr;
  std::vector<std::string> names;      // one for each component; of a list one
  std::vector<std::uint32_t> of_item;  // of each point or face its value, or kNone; not of a list
  bool is_list = false;
  Storage storage = Storage::real64;
};

// Double for integers that int cannot hold.
Storage storage_in_file(const CornerAttribute& attribute) {
  using Limits = std::numeric_limits<std::int32_t>;
  const auto fits = [](double value) {
    return std::isnan(value) || (value >= Limits::min() && value <= Limits::max());
  };
  const std::vector<double>& values = attribute.values;
  const bool is_int = attribute.storage == Storage::integer;
  return is_int && !std::all_of(values.begin(), values.end(), fits) ? Storage::real64
                                                                    : attribute.storage;
}

// An integer property of faces.
struct PlyNumbers {
  std::string_view name;
  std::vector<std::uint32_t> of_face;  // kNone is -1
};

std::string_view type_name(Storage storage) {
  switch (storage) {
    case Storage::real32:
      return "float";
    case Storage::byte:
      return "uchar";
    case Storage::integer:
      return "int";
    case Storage::real64:
      break;
  }
  return "double";
}

// Of the properties of kinds that other programs know.
std::string_view usual_name(Kind kind, std::size_t component) {
  constexpr std::array<std::string_view, 4> kTexture = {"s", "t", "r", "q"};
  constexpr std::array<std::string_view, 4> kNormal = {"nx", "ny", "nz", "nw"};
  constexpr std::array<std::string_view, 4> kColour = {"red", "green", "blue", "alpha"};
  if (component >= 4) return {};
  if (kind == Kind::texture) return kTexture[component];
  if (kind == Kind::normal) return kNormal[component];
  return kind == Kind::colour ? kColour[component] : std::string_view();
}

std::string component_name(const CornerAttribute& attribute, std::size_t component) {
  std::string name(usual_name(attribute.kind, component));
  if (!name.empty()) return name;
  name = attribute.kind == Kind::tangent ? "tangent" : attribute.name;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) <= ' '; }, '_');
  if (attribute.components > 1) name.append("_").append(std::to_string(component));
  return name;
}

std::vector<std::string> component_names(const CornerAttribute& attribute) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < attribute.components; ++i) {
    names.push_back(component_name(attribute, i));
  }
  return names;
}

// Which properties there are to be.
class PlyLayout {
 public:
  PlyLayout(const TriangleSoup& soup, const SoupExtras& extras) : soup_(soup), extras_(extras) {
    MESHREPAIR_ASSERT(extras.sources.empty() || extras.sources.size() == soup.triangles.size());
    if (extras.attributes != nullptr) {
      if (!extras.attributes->materials.empty()) used_of_faces_.emplace(kPlyMaterial);
      if (!extras.attributes->images.empty()) used_of_faces_.emplace(kPlyTexture);
      if (!extras.attributes->groups.empty()) used_of_faces_.emplace(kPlyGroup);
      if (!extras.attributes->objects.empty()) used_of_faces_.emplace(kPlyObject);
      for (const CornerAttribute& attribute : extras.attributes->corners) add(attribute);
      add_materials(*extras.attributes);
      add_names(kPlyGroup, kPlyGroupComment, extras.attributes->groups);
      add_names(kPlyObject, kPlyObjectComment, extras.attributes->objects);
    }
    if (!extras.sources.empty()) {
      numbers.push_back({kPlySource, {extras.sources.begin(), extras.sources.end()}});
    }
  }

  [[nodiscard]] std::string header(std::string_view format) const {
    std::string out = "ply\nformat " + std::string(format) + " 1.0\n";
    for (const std::string& comment : extras_.comments) out += "comment " + comment + "\n";
    out += comments_;
    out += "element vertex " + std::to_string(soup_.points.size()) +
           "\nproperty double x\nproperty double y\nproperty double z\n";
    append_properties(points, out);
    out += "element face " + std::to_string(soup_.triangles.size()) +
           "\nproperty list uchar uint vertex_indices\n";
    append_properties(faces, out);
    for (const PlyNumbers& list : numbers) out += "property int " + std::string(list.name) + "\n";
    return out + "end_header\n";
  }

  std::vector<PlyColumns> points, faces;
  std::vector<PlyNumbers> numbers;

 private:
  static void append_properties(const std::vector<PlyColumns>& columns, std::string& out) {
    for (const PlyColumns& column : columns) {
      for (const std::string& name : column.names) {
        out += column.is_list ? "property list uchar " : "property ";
        out.append(type_name(column.storage)).append(" ").append(name).append("\n");
      }
    }
  }

  void add(const CornerAttribute& attribute) {
    if (attribute.kind == Kind::skin) return;
    const bool is_later_set = attribute.kind == Kind::texture && textures_++ > 0;
    if (attribute.place == Place::triangle) {
      if (auto of_face = values_by_triangle(attribute)) {
        return add_columns(attribute, std::move(*of_face), faces);
      }
    }
    std::optional<std::vector<std::uint32_t>> of_point;
    if (!is_later_set) of_point = values_by_point(soup_, attribute);
    if (of_point) return add_columns(attribute, std::move(*of_point), points);
    if (attribute.kind == Kind::texture) return add_list(attribute);
    if (attribute.kind == Kind::normal || attribute.kind == Kind::tangent) return;
    if (auto of_face = values_by_triangle(attribute)) {
      return add_columns(attribute, std::move(*of_face), faces);
    }
    add_columns(attribute, first_values_by_point(soup_, attribute), points);
  }

  void add_columns(const CornerAttribute& attribute, std::vector<std::uint32_t> of_item,
                   std::vector<PlyColumns>& columns) {
    std::set<std::string, std::less<>>& used =
        &columns == &points ? used_of_points_ : used_of_faces_;
    std::vector<std::string> names = component_names(attribute);
    for (std::string& name : names) {
      while (!used.insert(name).second) name += '_';
    }
    columns.push_back(
        {&attribute, std::move(names), std::move(of_item), false, storage_in_file(attribute)});
  }

  // Lists have two numbers for each corner.
  void add_list(const CornerAttribute& attribute) {
    std::string name(kPlyTextureList);
    if (textures_ > 1) name += std::to_string(textures_ - 1);
    faces.push_back({&attribute, {std::move(name)}, {}, true, storage_in_file(attribute)});
  }

  void add_comment(std::string_view word, std::string_view what) {
    comments_.append("comment ").append(word).append(" ").append(what).append("\n");
  }

  void add_names(std::string_view property, std::string_view word, const TriangleLabels& labels) {
    if (labels.empty()) return;
    for (const std::string& name : labels.names) add_comment(word, name);
    numbers.push_back({property, labels.of_triangle});
  }

  void add_materials(const Attributes& attributes) {
    if (attributes.materials.empty()) return;
    add_names(kPlyMaterial, kPlyMaterialComment, attributes.materials);
    // Pictures that are no files have no name here.
    std::vector<std::uint32_t> texture_of(attributes.images.size(), kNone);
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < attributes.images.size(); ++i) {
      if (attributes.images[i].bytes) continue;
      texture_of[i] = count++;
      const Image& image = attributes.images[i];
      add_comment(kPlyTextureComment,
                  image.path.empty() ? image.name : name_seen_from(extras_.folder, image.path));
    }
    if (count == 0) return;
    std::vector<std::uint32_t> of_face;
    of_face.reserve(soup_.triangles.size());
    for (const std::uint32_t material : attributes.materials.of_triangle) {
      const std::uint32_t image =
          material < attributes.looks.size() ? attributes.looks[material].image : kNone;
      of_face.push_back(image == kNone ? kNone : texture_of[image]);
    }
    numbers.push_back({kPlyTexture, std::move(of_face)});
  }

  const TriangleSoup& soup_;
  const SoupExtras& extras_;
  std::size_t textures_ = 0;
  std::string comments_;
  // A name that is there twice would be read as that of one property.
  std::set<std::string, std::less<>> used_of_points_ = {"x", "y", "z", std::string(kPlySource)};
  std::set<std::string, std::less<>> used_of_faces_ = {"vertex_indices", std::string(kPlySource)};
};

// Appends numbers as bytes, without blanks between.
struct PlyBytes {
  template <class Number>
  static void append(std::string& out, Number number) {
    out.append(reinterpret_cast<const char*>(&number), sizeof number);
  }
};

// Appends numbers as digits, with a blank before each.
struct PlyDigits {
  template <class Number>
  static void append(std::string& out, Number number) {
    out += ' ';
    if constexpr (sizeof number == 1) {
      append_number(out, static_cast<int>(number));
    } else {
      append_number(out, number);
    }
  }
};

template <class Numbers>
void append_stored(std::string& out, double value, Storage storage) {
  const double whole = std::isnan(value) ? 0 : value;
  switch (storage) {
    case Storage::real32:
      return Numbers::append(out, static_cast<float>(value));
    case Storage::byte:
      return Numbers::append(
          out, static_cast<std::uint8_t>(std::lround(255 * std::clamp(whole, 0.0, 1.0))));
    case Storage::integer:
      return Numbers::append(
          out, static_cast<std::int32_t>(
                   std::clamp(std::round(whole), double{std::numeric_limits<std::int32_t>::min()},
                              double{std::numeric_limits<std::int32_t>::max()})));
    case Storage::real64:
      break;
  }
  Numbers::append(out, value);
}

template <class Numbers>
void append_value(std::string& out, const PlyColumns& column, std::uint32_t value) {
  const CornerAttribute& attribute = *column.attribute;
  for (std::size_t i = 0; i < attribute.components; ++i) {
    append_stored<Numbers>(out,
                           value == kNone ? std::numeric_limits<double>::quiet_NaN()
                                          : attribute.values[attribute.components * value + i],
                           column.storage);
  }
}

// Of a triangle; without a single number if a corner has none.
template <class Numbers>
void append_list(std::string& out, const PlyColumns& column, std::size_t t) {
  const CornerAttribute& attribute = *column.attribute;
  const std::uint32_t* const values = attribute.of_corner.data() + 3 * t;
  const bool has_all = std::find(values, values + 3, kNone) == values + 3;
  Numbers::append(out, static_cast<std::uint8_t>(has_all ? 6 : 0));
  for (std::size_t k = 0; has_all && k < 3; ++k) {
    for (std::size_t i = 0; i < 2; ++i) {
      append_stored<Numbers>(out, attribute.values[attribute.components * values[k] + i],
                             column.storage);
    }
  }
}

template <class Numbers>
void append_face_values(std::string& out, const PlyLayout& layout, std::size_t t) {
  for (const PlyColumns& column : layout.faces) {
    if (column.is_list) {
      append_list<Numbers>(out, column, t);
    } else {
      append_value<Numbers>(out, column, column.of_item[t]);
    }
  }
  for (const PlyNumbers& list : layout.numbers) {
    Numbers::append(out, static_cast<std::int32_t>(list.of_face[t]));  // as an int all ones are -1
  }
}

}  // namespace

std::string format_ply_binary(const TriangleSoup& soup, const SoupExtras& extras) {
  const PlyLayout layout(soup, extras);
  std::string out = layout.header("binary_little_endian");
  out.reserve(out.size() + 24 * soup.points.size() +
              (13 + 4 * layout.numbers.size()) * soup.triangles.size());
  for (std::size_t p = 0; p < soup.points.size(); ++p) {
    out.append(reinterpret_cast<const char*>(soup.points[p].data()), 3 * sizeof(double));
    for (const PlyColumns& column : layout.points) {
      append_value<PlyBytes>(out, column, column.of_item[p]);
    }
  }
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    out += '\3';
    out.append(reinterpret_cast<const char*>(soup.triangles[t].data()), sizeof soup.triangles[t]);
    append_face_values<PlyBytes>(out, layout, t);
  }
  return out;
}

std::string format_ply_ascii(const TriangleSoup& soup, const SoupExtras& extras) {
  const PlyLayout layout(soup, extras);
  std::string out = layout.header("ascii");
  append_lines(out, soup.points.size(), [&](std::string& lines, std::size_t p) {
    append_triple(lines, soup.points[p]);
    for (const PlyColumns& column : layout.points) {
      append_value<PlyDigits>(lines, column, column.of_item[p]);
    }
    lines += '\n';
  });
  append_lines(out, soup.triangles.size(), [&](std::string& lines, std::size_t t) {
    lines += "3 ";
    append_triple(lines, soup.triangles[t]);
    append_face_values<PlyDigits>(lines, layout, t);
    lines += '\n';
  });
  return out;
}

}  // namespace meshrepair
