// SPDX-License-Identifier: MIT
// What has to come back of a soup from a file, as docs/attributes.md says it: written down once
// more, to compare the readers and writers with.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include <base/file_bytes.h>
#include <mesh/attributes.h>
#include <mesh/precision.h>
#include <mesh/soup_io.h>

namespace meshrepair {

// The values of one attribute; an empty one says nothing.
struct ExpectedSet {
  CornerAttribute::Kind kind;
  std::size_t number;  // among those of the kind
  std::vector<std::vector<double>> of_corner;
};

struct ExpectedMesh {
  std::vector<std::size_t> order;  // of the triangles in the file
  std::vector<ExpectedSet> sets;
  std::vector<std::string> materials;          // of the triangles, "-" for none
  std::vector<std::optional<Material>> looks;  // of the triangles
  std::vector<std::string> pictures;           // of the triangles
  std::vector<std::string> groups, objects, smoothing;
};

inline bool is_ply(SoupFormat format) {
  return format == SoupFormat::ply_binary || format == SoupFormat::ply_ascii;
}

inline bool is_gltf(SoupFormat format) {
  return format == SoupFormat::glb || format == SoupFormat::gltf;
}

inline bool is_stl(SoupFormat format) {
  return format == SoupFormat::stl_binary || format == SoupFormat::stl_ascii;
}

inline std::vector<std::string> names_by_triangle(const TriangleLabels& labels,
                                                  std::size_t triangles) {
  std::vector<std::string> names(triangles, "-");
  for (std::size_t t = 0; t < labels.of_triangle.size(); ++t) {
    if (labels.of_triangle[t] != kNone) names[t] = labels.names[labels.of_triangle[t]];
  }
  return names;
}

inline std::string picture_of(const Attributes& attributes, std::uint32_t material) {
  if (material >= attributes.looks.size()) return {};
  const std::uint32_t image = attributes.looks[material].image;
  if (image >= attributes.images.size()) return {};
  const Image& known = attributes.images[image];
  if (known.bytes) return *known.bytes;
  std::error_code error;
  if (!std::filesystem::is_regular_file(known.path, error)) return {};
  return std::string(FileBytes(known.path).bytes());
}

class ExpectedMaker {
 public:
  ExpectedMaker(SoupFormat format, const TriangleSoup& soup, const Attributes& all)
      : format_(format), soup_(soup), attributes_(held_by(format, all)) {}

  ExpectedMesh run() {
    const std::size_t triangles = soup_.triangles.size();
    made_.order.resize(triangles);
    std::iota(made_.order.begin(), made_.order.end(), std::size_t{0});
    const TriangleLabels& materials = attributes_.materials;
    if (is_gltf(format_)) {  // a node for each object, a primitive for each of its materials
      sort_by(materials);
      sort_by(attributes_.objects);
    }
    if (format_ == SoupFormat::stl_ascii) sort_by(attributes_.groups);
    if (is_stl(format_)) forget_single(attributes_.groups);
    made_.materials = names_by_triangle(materials, triangles);
    made_.groups = names_by_triangle(attributes_.groups, triangles);
    made_.objects = names_by_triangle(attributes_.objects, triangles);
    made_.smoothing = names_by_triangle(attributes_.smoothing, triangles);
    expect_looks();
    std::vector<std::size_t> counts(5, 0);
    for (const CornerAttribute& set : attributes_.corners) {
      const std::size_t number = counts[static_cast<std::size_t>(set.kind)]++;
      expect_set(set, number);
    }
    return std::move(made_);
  }

 private:
  using CornerKind = CornerAttribute::Kind;

  void sort_by(const TriangleLabels& labels) {
    if (labels.empty()) return;
    std::stable_sort(made_.order.begin(), made_.order.end(), [&](std::size_t a, std::size_t b) {
      return labels.of_triangle[a] < labels.of_triangle[b];
    });
  }

  // What has one name alone has no groups.
  static void forget_single(TriangleLabels& groups) {
    const auto& labels = groups.of_triangle;
    const bool is_one = std::all_of(labels.begin(), labels.end(),
                                    [&](std::uint32_t label) { return label == labels.front(); });
    if (is_one) groups = {};
  }

  void expect_looks() {
    made_.looks.resize(soup_.triangles.size());
    made_.pictures.resize(soup_.triangles.size());
    if (is_ply(format_) || attributes_.looks.empty()) return;
    for (std::size_t t = 0; t < attributes_.materials.of_triangle.size(); ++t) {
      const std::uint32_t material = attributes_.materials.of_triangle[t];
      if (material == kNone) continue;
      Material look = attributes_.looks[material];
      if (format_ == SoupFormat::threemf) {
        for (double& value : look.colour) value = as_byte(value);
      }
      made_.looks[t] = look;
      // A package has pictures only where there are places in them.
      if (format_ != SoupFormat::threemf) made_.pictures[t] = picture_of(attributes_, material);
    }
  }

  void expect_set(const CornerAttribute& set, std::size_t number) {
    if (format_ == SoupFormat::stl_binary) return expect_stl_colours(set, number);
    if (!is_held(set)) return;
    ExpectedSet made{set.kind, number, std::vector<std::vector<double>>(set.of_corner.size())};
    for (std::size_t t = 0; t < soup_.triangles.size(); ++t) {
      if (format_ == SoupFormat::threemf && !is_held_in_package(set, t)) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t value = set.of_corner[3 * t + k];
        if (value == kNone) continue;
        for (std::size_t i = 0; i < set.components; ++i) {
          if (format_ == SoupFormat::obj && set.kind == CornerKind::colour && i == 3) break;
          made.of_corner[3 * t + k].push_back(written(set, set.values[set.components * value + i]));
        }
      }
    }
    made_.sets.push_back(std::move(made));
  }

  // Where formats have values for points or triangles alone.
  [[nodiscard]] bool is_held(const CornerAttribute& set) const {
    const bool by_point = values_by_point(soup_, set).has_value();
    if (format_ == SoupFormat::obj) return set.kind != CornerKind::colour || by_point;
    if (!is_ply(format_) || set.kind == CornerKind::texture) return true;
    const bool is_of_triangles = set.place == CornerAttribute::Place::triangle ||
                                 set.kind == CornerKind::colour || set.kind == CornerKind::other;
    return by_point || (is_of_triangles && values_by_triangle(set).has_value());
  }

  [[nodiscard]] bool is_held_in_package(const CornerAttribute& set, std::size_t t) const {
    for (std::size_t k = 0; k < 3; ++k) {
      if (set.of_corner[3 * t + k] == kNone) return false;
    }
    if (set.kind != CornerKind::texture) return true;
    return !attributes_.materials.empty() &&
           !picture_of(attributes_, attributes_.materials.of_triangle[t]).empty();
  }

  // One of five bits for each triangle, if all its corners have the same.
  void expect_stl_colours(const CornerAttribute& set, std::size_t number) {
    ExpectedSet made{set.kind, number, std::vector<std::vector<double>>(set.of_corner.size())};
    for (std::size_t t = 0; t < soup_.triangles.size(); ++t) {
      const std::uint32_t value = set.of_corner[3 * t];
      if (value == kNone || set.of_corner[3 * t + 1] != value ||
          set.of_corner[3 * t + 2] != value) {
        continue;
      }
      for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t i = 0; i < 3; ++i) {
          const double share = set.values[set.components * value + i];
          made.of_corner[3 * t + k].push_back(as_byte(std::round(share * 31) / 31));
        }
      }
    }
    made_.sets.push_back(std::move(made));
  }

  static double as_byte(double share) {
    return std::round(255 * std::clamp(share, 0.0, 1.0)) / 255;
  }

  [[nodiscard]] double written(const CornerAttribute& set, double value) const {
    using Storage = CornerAttribute::Storage;
    const bool is_colour = set.kind == CornerKind::colour;
    if (format_ == SoupFormat::threemf) return is_colour ? as_byte(value) : value;
    if (format_ == SoupFormat::obj) return value;
    if (set.storage == Storage::byte && (is_colour || is_ply(format_))) return as_byte(value);
    const bool is_single = is_gltf(format_) || set.storage == Storage::real32;
    return is_single ? rounded_to_float32(value) : value;
  }

  SoupFormat format_;
  const TriangleSoup& soup_;
  Attributes attributes_;
  ExpectedMesh made_;
};

inline ExpectedMesh expected_in(SoupFormat format, const TriangleSoup& soup,
                                const Attributes& attributes) {
  return ExpectedMaker(format, soup, attributes).run();
}

}  // namespace meshrepair
