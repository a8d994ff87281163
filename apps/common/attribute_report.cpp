#include "common/attribute_report.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include <spdlog/fmt/fmt.h>

#include <mesh/float32.h>
#include <mesh/seams.h>

#include "common/summary.h"

namespace meshrepair {
namespace {

using Kind = CornerAttribute::Kind;

std::string kind_words(const CornerAttribute& attribute) {
  switch (attribute.kind) {
    case Kind::texture:
      return "texture coordinates";
    case Kind::normal:
      return "normals";
    case Kind::tangent:
      return "tangents";
    case Kind::colour:
      return "colours";
    case Kind::other:
      break;
  }
  return "'" + attribute.name + "'";
}

std::string_view kind_name(Kind kind) {
  constexpr std::array<std::string_view, 5> kNames = {"texture", "normal", "tangent", "colour",
                                                      "other"};
  return kNames[static_cast<std::size_t>(kind)];
}

// OBJ has colours of points alone, and PLY what is no texture for points or for triangles; normals
// for points alone.
bool has_place_for(SoupFormat format, const TriangleSoup& soup, const CornerAttribute& attribute) {
  const bool is_ply = holds_sources(format);
  const bool is_normal = attribute.kind == Kind::normal;
  if (!is_ply && format != SoupFormat::obj) return true;
  if (attribute.kind == Kind::texture || (!is_ply && is_normal)) return true;
  if (values_by_point(soup, attribute)) return true;
  return is_ply && !is_normal && values_by_triangle(attribute);
}

using NamedLabels = std::pair<std::string_view, const TriangleLabels*>;

std::array<NamedLabels, 4> all_labels(const Attributes& attributes) {
  return {{{"material", &attributes.materials},
           {"group", &attributes.groups},
           {"object", &attributes.objects},
           {"smoothing group", &attributes.smoothing}}};
}

// 3MF lays no coordinates without a picture that it can hold.
bool has_unused_places(const Attributes& attributes) {
  const CornerAttribute* const places = find_kind(attributes, Kind::texture);
  if (places == nullptr) return false;
  const auto has_picture = [&](std::size_t t) {
    const auto& labels = attributes.materials;
    const std::uint32_t material = labels.empty() ? kNone : labels.of_triangle[t];
    if (material >= attributes.looks.size()) return false;
    const std::uint32_t image = attributes.looks[material].image;
    if (image >= attributes.images.size()) return false;
    return attributes.images[image].bytes != nullptr || !attributes.images[image].path.empty();
  };
  for (std::size_t t = 0; 3 * t < places->of_corner.size(); ++t) {
    if (places->of_corner[3 * t] != kNone && !has_picture(t)) return true;
  }
  return false;
}

bool is_beyond_float32(const CornerAttribute& attribute) {
  return attribute.storage == CornerAttribute::Storage::integer &&
         std::any_of(attribute.values.begin(), attribute.values.end(),
                     [](double value) { return rounded_to_float32(value) != value; });
}

// Of attributes that the format does hold.
void add_lost_values(const Attributes& held, SoupFormat format, std::vector<std::string>& lost) {
  if (format == SoupFormat::threemf && has_unused_places(held)) {
    lost.emplace_back("texture coordinates where there is no picture");
  }
  if (format != SoupFormat::glb && format != SoupFormat::gltf) return;
  for (const CornerAttribute& attribute : held.corners) {
    if (is_beyond_float32(attribute)) lost.push_back("last digits of " + kind_words(attribute));
  }
}

}  // namespace

std::vector<std::string> attribute_words(const TriangleSoup& soup, const Attributes& attributes) {
  std::vector<std::string> words;
  for (const CornerAttribute& attribute : attributes.corners) {
    std::string text = kind_words(attribute);
    if (attribute.kind == Kind::texture) {
      text += fmt::format(" ({})", number_of(count_seams(soup, attribute), "edge") + " of seams");
    }
    words.push_back(std::move(text));
  }
  for (const auto& [name, labels] : all_labels(attributes)) {
    if (!labels->empty()) words.push_back(number_of(labels->names.size(), name));
  }
  if (!attributes.images.empty()) words.push_back(number_of(attributes.images.size(), "picture"));
  return words;
}

std::string lost_attributes(const TriangleSoup& soup, const Attributes& all, const Attributes& held,
                            SoupFormat format) {
  std::vector<std::string> lost;
  const auto count = [](const Attributes& attributes, const std::string& words) {
    return std::count_if(
        attributes.corners.begin(), attributes.corners.end(),
        [&](const CornerAttribute& attribute) { return kind_words(attribute) == words; });
  };
  for (const CornerAttribute& attribute : all.corners) {
    const std::string words = kind_words(attribute);
    const bool is_told = std::find(lost.begin(), lost.end(), words) != lost.end();
    if (!is_told && count(held, words) < count(all, words)) lost.push_back(words);
  }
  const auto before = all_labels(all), after = all_labels(held);
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (!before[i].second->empty() && after[i].second->empty()) {
      lost.push_back(std::string(before[i].first) + "s");
    }
  }
  for (const CornerAttribute& attribute : held.corners) {
    if (!has_place_for(format, soup, attribute)) {
      lost.push_back(kind_words(attribute) + " where triangles of one point have different ones");
    }
  }
  add_lost_values(held, format, lost);
  if (all.keepsake) {
    for (std::string& words : all.keepsake->lost_in(format)) lost.push_back(std::move(words));
  }
  return fmt::format("{}", fmt::join(lost, ", "));
}

Json attributes_section(const TriangleSoup& soup, const Attributes& attributes) {
  Json corners = Json::array();
  for (const CornerAttribute& attribute : attributes.corners) {
    corners.push_back({{"kind", kind_name(attribute.kind)},
                       {"name", attribute.name},
                       {"components", attribute.components},
                       {"values", attribute.count()},
                       {"seam_edges", count_seams(soup, attribute)}});
  }
  return {{"corners", corners},
          {"materials", attributes.materials.names},
          {"groups", attributes.groups.names},
          {"objects", attributes.objects.names},
          {"smoothing_groups", attributes.smoothing.names},
          {"pictures", attributes.images.size()}};
}

}  // namespace meshrepair
