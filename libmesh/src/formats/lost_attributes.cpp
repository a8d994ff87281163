// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include <base/ids.h>
#include <mesh/lost_attributes.h>
#include <mesh/precision.h>
#include <mesh/skins.h>
#include <mesh/triangle_paint.h>

#include "formats/obj/obj_io.h"
#include "formats/painted_materials.h"
#include "formats/threemf/threemf_io.h"

namespace meshrepair {
namespace {

using Kind = CornerAttribute::Kind;

bool is_gltf(SoupFormat format) { return format == SoupFormat::glb || format == SoupFormat::gltf; }

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

bool is_beyond_float32(const CornerAttribute& attribute) {
  return attribute.storage == CornerAttribute::Storage::integer &&
         std::any_of(attribute.values.begin(), attribute.values.end(),
                     [](double value) { return rounded_to_float32(value) != value; });
}

bool has_opacity(const CornerAttribute& attribute) {
  if (attribute.kind != Kind::colour || attribute.components != 4) return false;
  for (std::size_t i = 3; i < attribute.values.size(); i += 4) {
    if (attribute.values[i] != 1) return true;
  }
  return false;
}

class Finder {
 public:
  Finder(const TriangleSoup& soup, const Attributes& all, const Attributes& held, SoupFormat format)
      : soup_(soup), all_(all), held_(held), format_(format) {}

  std::vector<std::string> run() {
    find_kinds();
    find_labels();
    for (const CornerAttribute& attribute : held_.corners) find_values(attribute);
    if (!held_.materials.empty()) find_looks();
    if (format_ == SoupFormat::threemf && has_unused_places()) {
      add("texture coordinates where there is no picture");
    }
    if (all_.keepsake) {
      for (std::string& words : all_.keepsake->lost_in(format_)) add(std::move(words));
    }
    return std::move(lost_);
  }

 private:
  void add(std::string words) {
    if (!is_told(words)) lost_.push_back(std::move(words));
  }

  [[nodiscard]] bool is_told(const std::string& words) const {
    return std::find(lost_.begin(), lost_.end(), words) != lost_.end();
  }

  void find_kinds() {
    const auto count = [](const Attributes& attributes, const std::string& words) {
      return std::count_if(
          attributes.corners.begin(), attributes.corners.end(),
          [&](const CornerAttribute& attribute) { return kind_words(attribute) == words; });
    };
    for (const CornerAttribute& attribute : all_.corners) {
      const std::string words = kind_words(attribute);
      if (count(held_, words) < count(all_, words)) add(words);
    }
  }

  void find_labels() {
    using Labels = TriangleLabels Attributes::*;
    constexpr std::array<std::pair<std::string_view, Labels>, 4> kLabels = {
        {{"materials", &Attributes::materials},
         {"groups", &Attributes::groups},
         {"objects", &Attributes::objects},
         {"smoothing groups", &Attributes::smoothing}}};
    for (const auto& [words, labels] : kLabels) {
      const bool is_of_region = labels == &Attributes::groups || labels == &Attributes::objects;
      const bool is_there = is_of_region ? has_names(all_.*labels) : !(held_.*labels).empty();
      if (!(all_.*labels).empty() && !is_there) add(std::string(words));
    }
    if (!held_.paints.empty()) return;
    const TrianglePaint* const filaments = filament_paint(all_);
    const bool are_materials = all_.materials.empty() && !held_.materials.empty();
    for (const TrianglePaint& paint : all_.paints) {
      if (&paint != filaments || !are_materials) {
        add("'" + paint.name + "'");
      } else if (std::any_of(
                     paint.codes.names.begin(), paint.codes.names.end(),
                     [](const std::string& code) { return PaintCode(code).is_divided(); })) {
        add("'" + paint.name + "' of parts of triangles");
      }
    }
  }

  // Formats with one list of names have groups as objects, or objects as groups.
  [[nodiscard]] bool has_names(const TriangleLabels& labels) const {
    if (labels.names == held_.groups.names || labels.names == held_.objects.names) return true;
    std::unordered_set<std::string_view> held(held_.groups.names.begin(), held_.groups.names.end());
    held.insert(held_.objects.names.begin(), held_.objects.names.end());
    return std::all_of(
        labels.of_triangle.begin(), labels.of_triangle.end(),
        [&](std::uint32_t label) { return label == kNone || held.contains(labels.names[label]); });
  }

  // Of an attribute that the format does hold.
  void find_values(const CornerAttribute& attribute) {
    if (!has_place_for(format_, soup_, attribute)) {
      add(kind_words(attribute) + " where triangles of one point have different ones");
    }
    const bool has_no_opacity = format_ == SoupFormat::obj || format_ == SoupFormat::stl_binary;
    if (has_no_opacity && has_opacity(attribute)) add("opacity of colours");
    if (is_gltf(format_) && is_beyond_float32(attribute)) {
      add("last digits of " + kind_words(attribute));
    }
  }

  // Libraries of materials say of theirs what they said.
  void find_looks() {
    std::unordered_set<std::string> said;
    if (format_ == SoupFormat::obj) said = library_materials(held_);
    for (const std::uint32_t m : used_materials()) {
      const Material& look = held_.looks[m];
      if (said.contains(held_.materials.names[m])) continue;
      if (holds_sources(format_) && look.colour != Material().colour) add("colours of materials");
      if (look.image >= held_.images.size()) continue;
      if (holds_sources(format_) && held_.images[look.image].bytes) {
        add("pictures that are no files");
      }
      if (format_ == SoupFormat::threemf && !is_held(look.image)) {
        add("pictures that are not there, or neither PNG nor JPEG");
      }
      find_sampling(look.sampling);
    }
  }

  void find_sampling(const TextureSampling& sampling) {
    using Wrap = TextureSampling::Wrap;
    const auto& [u, v] = sampling.wrap;
    if (format_ == SoupFormat::threemf) return;
    const bool is_plain = u == Wrap::repeat && v == Wrap::repeat;
    const bool is_obj = format_ == SoupFormat::obj && u == v && u == Wrap::clamp;
    const bool is_in_gltf = is_gltf(format_) && u != Wrap::none && v != Wrap::none;
    if (!is_plain && !is_obj && !is_in_gltf) add("what pictures are beyond their edges");
    if (!is_gltf(format_) && sampling.filter == TextureSampling::Filter::nearest) {
      add("pictures without anything between their pixels");
    }
  }

  [[nodiscard]] std::vector<std::uint32_t> used_materials() const {
    std::vector<char> is_used(held_.looks.size(), 0);
    for (const std::uint32_t m : held_.materials.of_triangle) {
      if (m < is_used.size()) is_used[m] = 1;
    }
    std::vector<std::uint32_t> used;
    for (std::uint32_t m = 0; m < is_used.size(); ++m) {
      if (is_used[m] != 0) used.push_back(m);
    }
    return used;
  }

  // 3MF lays no coordinates without a picture that it can hold.
  [[nodiscard]] bool has_unused_places() {
    const CornerAttribute* const places = find_kind(held_, Kind::texture);
    if (places == nullptr || is_told(kind_words(*places))) return false;
    const auto has_picture = [&](std::size_t t) {
      const auto& labels = held_.materials;
      const std::uint32_t material = labels.empty() ? kNone : labels.of_triangle[t];
      if (material >= held_.looks.size()) return false;
      const std::uint32_t image = held_.looks[material].image;
      return image < held_.images.size() && is_held(image);
    };
    for (std::size_t t = 0; 3 * t < places->of_corner.size(); ++t) {
      if (places->of_corner[3 * t] != kNone && !has_picture(t)) return true;
    }
    return false;
  }

  // By 3MF. Each is looked at once.
  bool is_held(std::uint32_t image) {
    const auto [known, is_new] = is_held_.try_emplace(image, false);
    if (is_new) known->second = can_be_in_threemf(held_.images[image]);
    return known->second;
  }

  const TriangleSoup& soup_;
  const Attributes& all_;
  const Attributes& held_;
  SoupFormat format_;
  std::vector<std::string> lost_;
  std::unordered_map<std::uint32_t, bool> is_held_;  // images
};

}  // namespace

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
    case Kind::skin:
      return "weights of joints";
    case Kind::other:
      break;
  }
  if (morph_target_of(attribute)) return "morph targets";
  return "'" + attribute.name + "'";
}

std::vector<std::string> lost_attributes(const TriangleSoup& soup, const Attributes& all,
                                         const Attributes& held, SoupFormat format) {
  return Finder(soup, all, held, format).run();
}

}  // namespace meshrepair
