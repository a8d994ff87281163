// SPDX-License-Identifier: MIT
// Random soups with attributes of all kinds and places, in numbers that every format holds.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "small_pictures.h"
#include "textured_soups.h"

namespace meshrepair {

class MixedSoupMaker {
 public:
  explicit MixedSoupMaker(std::uint64_t seed) : random_(seed) {}

  TexturedSoup run() {
    make_triangles();
    make_materials();
    if (chance(3)) {
      make_labels(soup_.attributes.groups, {"wheels", "body  and <more>"});
      make_labels(soup_.attributes.objects, {"car", "the other car", "gl\xC3\xA4s"});
    } else {
      make_labels(soup_.attributes.groups, {"7", "32767", "1"});
    }
    make_labels(soup_.attributes.smoothing, {"1", "2", "off"});
    make_textures();
    if (chance(3)) add(CornerKind::normal, 3, any_place(), 0);
    if (chance(2)) add(CornerKind::tangent, 4, any_place(), 0);
    make_colours();
    if (chance(2)) {
      add(CornerKind::other, 1 + below(4), any_place(), 0);
      soup_.attributes.corners.back().name = "_QUALITY";
    }
    return std::move(soup_);
  }

 private:
  using Place = CornerAttribute::Place;
  using CornerKind = CornerAttribute::Kind;

  std::uint32_t below(std::size_t count) { return static_cast<std::uint32_t>(random_() % count); }
  // In all cases but one of so many.
  bool chance(std::size_t most) { return below(most + 1) > 0; }

  Place any_place() {
    constexpr std::array<Place, 4> kPlaces = {Place::corner, Place::corner, Place::point,
                                              Place::triangle};
    return kPlaces[below(kPlaces.size())];
  }

  // Three different corners each; coordinates of single precision.
  void make_triangles() {
    const std::uint32_t points = 6 + below(50);
    for (std::uint32_t i = 0; i < points; ++i) {
      const auto coordinate = [&] {
        const double sign = below(2) == 0 ? -1 : 1;
        return sign * rounded_to_float32(static_cast<double>(1 + below(1u << 30)) / 7e4);
      };
      const double x = coordinate(), y = coordinate();
      soup_.soup.points.emplace_back(x, y, coordinate());
    }
    const std::uint32_t triangles = 1 + below(100);
    for (std::uint32_t i = 0; i < triangles; ++i) {
      const std::uint32_t a = below(points);
      const std::uint32_t b = (a + 1 + below(points - 2)) % points;
      std::uint32_t c = below(points);
      while (c == a || c == b) c = (c + 1) % points;
      soup_.soup.triangles.push_back({a, b, c});
    }
  }

  double byte() { return static_cast<double>(below(256)) / 255; }

  void make_materials() {
    Attributes& attributes = soup_.attributes;
    if (!chance(5)) return;
    attributes.materials.names = {"steel", "wood, oiled", "gl\xC3\xA4s", "wood too", "4"};
    const auto level = [&] { return static_cast<std::uint8_t>(below(256)); };
    for (int i = 0; i < 2; ++i) {
      const std::uint8_t red = level(), green = level();
      auto bytes = std::make_shared<const std::string>(one_pixel_png(red, green, level()));
      attributes.images.push_back({"p.png", "image/png", "", std::move(bytes)});
    }
    for (std::size_t m = 0; m < attributes.materials.names.size(); ++m) {
      attributes.looks.push_back({{byte(), byte(), byte(), byte()}, kNone});
    }
    attributes.looks[1].image = 0;
    attributes.looks[3].image = 0;
    attributes.looks[4].image = 1;
    make_labels(attributes.materials, attributes.materials.names);
    if (attributes.materials.empty()) attributes.materials.of_triangle.assign(triangles(), 0);
  }

  // Some triangles have none.
  void make_labels(TriangleLabels& labels, std::vector<std::string> names) {
    if (!chance(4)) return;
    labels.names = std::move(names);
    const bool all = below(2) == 0;
    for (std::size_t t = 0; t < triangles(); ++t) {
      const std::uint32_t label = below(labels.names.size() + (all ? 0 : 1));
      labels.of_triangle.push_back(label == labels.names.size() ? kNone : label);
    }
  }

  void make_textures() {
    const std::size_t count = below(3);
    for (std::size_t i = 0; i < count; ++i) {
      add(CornerKind::texture, 2, below(2) == 0 ? Place::corner : Place::point, i == 0 ? 6 : 0);
    }
  }

  // In bytes, or of five bits for each triangle, or in single precision.
  void make_colours() {
    if (!chance(4)) return;
    const std::uint32_t kind = below(4);
    add(CornerKind::colour, kind == 0 ? 3 : 3 + below(2), kind == 0 ? Place::triangle : any_place(),
        below(2) == 0 ? 5 : 0);
    CornerAttribute& colours = soup_.attributes.corners.back();
    if (kind == 3) return;
    colours.storage = CornerAttribute::Storage::byte;
    for (double& value : colours.values) {
      value = kind == 0 ? std::round(below(32) * 255.0 / 31) / 255 : byte();
    }
  }

  // One triangle in `without` has no values, if that is not 0.
  void add(CornerKind kind, std::size_t components, Place place, std::uint32_t without) {
    CornerAttribute set = random_attribute(kind, components, 3 * triangles(), random_);
    set.place = place;
    const auto count = static_cast<std::uint32_t>(set.count());
    for (std::size_t t = 0; t < triangles(); ++t) {
      const bool has_none = without > 0 && below(without) == 0 && place != Place::point;
      for (std::size_t k = 0; k < 3; ++k) {
        std::uint32_t& value = set.of_corner[3 * t + k];
        if (place == Place::point) value = soup_.soup.triangles[t][k] % count;
        if (place == Place::triangle) value = static_cast<std::uint32_t>(t) % count;
        if (has_none && t > 0) value = kNone;
      }
    }
    soup_.attributes.corners.push_back(std::move(set));
  }

  [[nodiscard]] std::size_t triangles() const { return soup_.soup.triangles.size(); }

  std::mt19937 random_;
  TexturedSoup soup_;
};

// The same for the same seed.
inline TexturedSoup random_mixed_soup(std::uint64_t seed) { return MixedSoupMaker(seed).run(); }

}  // namespace meshrepair
