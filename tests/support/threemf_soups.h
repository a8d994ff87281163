// SPDX-License-Identifier: MIT
// Soups with materials, colours and coordinates in textures, as 3MF can hold them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <base/ids.h>
#include <mesh/attributes.h>
#include <mesh/soup.h>

namespace meshrepair {

struct ThreemfSoup {
  TriangleSoup soup;
  Attributes attributes;
};

// An open sheet of 2 n^2 triangles; all corners of a triangle are different.
inline TriangleSoup proper_grid(std::uint32_t n) {
  TriangleSoup soup;
  for (std::uint32_t y = 0; y <= n; ++y) {
    for (std::uint32_t x = 0; x <= n; ++x) soup.points.emplace_back(x / 3.0, y * 1.1, x * y / 7.0);
  }
  for (std::uint32_t y = 0; y < n; ++y) {
    for (std::uint32_t x = 0; x < n; ++x) {
      const std::uint32_t a = y * (n + 1) + x, b = a + 1, c = a + n + 1, d = c + 1;
      soup.triangles.push_back({a, b, d});
      soup.triangles.push_back({a, d, c});
    }
  }
  return soup;
}

inline std::string tiny_png(int number) {
  return "\x89PNG\r\n\x1A\n picture " + std::to_string(number);
}

inline Attributes random_attributes(std::size_t triangles, std::mt19937& random, bool all) {
  using CornerKind = CornerAttribute::Kind;
  Attributes attributes;
  const auto share = [&] { return static_cast<double>(random() % 256) / 255.0; };
  attributes.materials.names = {"steel & <iron>", "wood", "gold \"24\"", "wood too", "gl\xC3\xA4s"};
  for (std::size_t m = 0; m < attributes.materials.names.size(); ++m) {
    attributes.looks.push_back({{share(), share(), share(), share()}, kNone});
  }
  for (int i = 0; i < 2; ++i) {
    auto bytes = std::make_shared<const std::string>(tiny_png(i));
    attributes.images.push_back({"p.png", "image/png", "", std::move(bytes)});
  }
  attributes.looks[1].image = 0;
  attributes.looks[3].image = 0;  // shared
  attributes.looks[4].image = 1;
  CornerAttribute points, colours;
  points.kind = CornerKind::texture;
  colours.kind = CornerKind::colour;
  colours.storage = CornerAttribute::Storage::byte;
  colours.components = 3 + random() % 2;
  std::uniform_real_distribution<double> real(-2, 2);
  for (int i = 0; i < 40; ++i) points.values.push_back(real(random));
  for (std::size_t i = 0; i < 10 * colours.components; ++i) colours.values.push_back(share());
  for (std::size_t t = 0; t < triangles; ++t) {
    const auto material = static_cast<std::uint32_t>(random() % (all ? 5 : 6));
    attributes.materials.of_triangle.push_back(material == 5 ? kNone : material);
    const bool has_picture = material == 1 || material == 3 || material == 4;
    const bool has_points = has_picture && (all || random() % 4 != 0);
    const bool has_colours = random() % 2 == 0;
    for (int k = 0; k < 3; ++k) {
      const auto value = [&](bool any, unsigned count) {
        return any ? static_cast<std::uint32_t>(random() % count) : kNone;
      };
      points.of_corner.push_back(value(has_points, 20));
      colours.of_corner.push_back(value(has_colours, 10));
    }
  }
  attributes.corners = {points, colours};
  return attributes;
}

// The same for the same seed.
inline ThreemfSoup random_threemf_soup(std::uint64_t seed) {
  std::mt19937 random(seed);
  ThreemfSoup made;
  made.soup = proper_grid(static_cast<std::uint32_t>(4 + random() % 6));
  made.attributes = random_attributes(made.soup.triangles.size(), random, seed % 2 == 0);
  return made;
}

}  // namespace meshrepair
