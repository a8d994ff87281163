// SPDX-License-Identifier: MIT
// Soups with all kinds of attributes, and the means to compare them.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <mesh/attributes.h>
#include <mesh/precision.h>
#include <mesh/soup.h>

#include "textured.h"

namespace meshrepair {

using testing::TexturedSoup;

inline CornerAttribute random_attribute(CornerAttribute::Kind kind, std::size_t components,
                                        std::size_t corners, std::mt19937& random) {
  CornerAttribute attribute;
  attribute.kind = kind;
  attribute.components = components;
  attribute.storage = CornerAttribute::Storage::real32;
  const std::size_t count = corners / 3 + 1;
  for (std::size_t i = 0; i < count; ++i) {
    // Single precision holds these, and one minus them.
    for (std::size_t k = 0; k < components; ++k)
      attribute.values.push_back(static_cast<double>(random() % 65537) / 65536);
    if (kind == CornerAttribute::Kind::normal || kind == CornerAttribute::Kind::tangent) {
      const double angle = 0.001 * static_cast<double>(random() % 6283);
      const std::size_t at = components * i;
      attribute.values[at] = rounded_to_float32(std::cos(angle));
      attribute.values[at + 1] = rounded_to_float32(std::sin(angle));
      attribute.values[at + 2] = 0;
      if (components == 4) attribute.values[at + 3] = random() % 2 == 0 ? 1 : -1;
    }
  }
  for (std::size_t i = 0; i < corners; ++i) {
    attribute.of_corner.push_back(static_cast<std::uint32_t>(random() % count));
  }
  return attribute;
}

// Coordinates that single precision holds; three materials, and triangles without.
inline TexturedSoup random_textured_soup(std::uint64_t seed) {
  using CornerKind = CornerAttribute::Kind;
  std::mt19937 random(seed);
  TexturedSoup made;
  for (int i = 0; i < 60; ++i) {
    const auto coordinate = [&] {
      return static_cast<double>(static_cast<float>(random()) / 7.0f);
    };
    const double x = coordinate(), y = coordinate();
    made.soup.points.emplace_back(x, y, coordinate());
  }
  const auto corner = [&] {
    return static_cast<std::uint32_t>(random() % made.soup.points.size());
  };
  TriangleLabels& materials = made.attributes.materials;
  materials.names = {"red", "green", "blue"};
  for (int i = 0; i < 100; ++i) {
    const std::uint32_t a = corner(), b = corner();
    made.soup.triangles.push_back({a, b, corner()});
    const auto label = static_cast<std::uint32_t>(random() % 4);
    materials.of_triangle.push_back(label == 3 ? kNone : label);
  }
  std::vector<CornerAttribute>& sets = made.attributes.corners;
  const std::size_t corners = 3 * made.soup.triangles.size();
  sets.push_back(random_attribute(CornerKind::texture, 2, corners, random));
  sets.push_back(random_attribute(CornerKind::texture, 2, corners, random));
  sets.push_back(random_attribute(CornerKind::normal, 3, corners, random));
  sets.push_back(random_attribute(CornerKind::tangent, 4, corners, random));
  sets.push_back(random_attribute(CornerKind::colour, 4, corners, random));
  sets.push_back(random_attribute(CornerKind::colour, 3, corners, random));
  sets.back().storage = CornerAttribute::Storage::byte;
  for (double& value : sets.back().values) value = static_cast<double>(random() % 256) / 255;
  sets.push_back(random_attribute(CornerKind::other, 1, corners, random));
  sets.back().name = "_QUALITY";
  return made;
}

// Of each triangle all that is known, bit for bit, in an order that does not depend on that of the
// triangles; of the kinds those up to `last`.
inline std::vector<std::vector<std::uint64_t>> facts_of(
    const TriangleSoup& soup, const Attributes& attributes,
    CornerAttribute::Kind last = CornerAttribute::Kind::other) {
  std::vector<std::vector<std::uint64_t>> all;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    std::vector<std::uint64_t> facts;
    const auto add = [&](double value) { facts.push_back(std::bit_cast<std::uint64_t>(value)); };
    for (std::size_t k = 0; k < 3; ++k) {
      for (const double coordinate : soup.points[soup.triangles[t][k]]) add(coordinate);
      for (const CornerAttribute& attribute : attributes.corners) {
        if (attribute.kind > last) continue;
        const std::uint32_t number = attribute.of_corner[3 * t + k];
        facts.push_back(number == kNone ? 0 : 1);
        if (number == kNone) continue;
        for (std::size_t i = 0; i < attribute.components; ++i) {
          add(attribute.values[attribute.components * number + i]);
        }
      }
    }
    const TriangleLabels& materials = attributes.materials;
    const std::uint32_t label = materials.empty() ? kNone : materials.of_triangle[t];
    for (const char c : label == kNone ? std::string("none") : materials.names[label]) {
      facts.push_back(static_cast<unsigned char>(c));
    }
    all.push_back(std::move(facts));
  }
  std::sort(all.begin(), all.end());
  return all;
}

// "" if they are the same, else where the first difference is.
inline std::string difference(const std::vector<std::vector<std::uint64_t>>& a,
                              const std::vector<std::vector<std::uint64_t>>& b) {
  if (a.size() != b.size()) return std::to_string(a.size()) + " and " + std::to_string(b.size());
  for (std::size_t t = 0; t < a.size(); ++t) {
    if (a[t].size() != b[t].size()) return "triangle " + std::to_string(t) + ", number of facts";
    for (std::size_t i = 0; i < a[t].size(); ++i) {
      if (a[t][i] == b[t][i]) continue;
      return "triangle " + std::to_string(t) + ", fact " + std::to_string(i) + ": " +
             std::to_string(std::bit_cast<double>(a[t][i])) + " and " +
             std::to_string(std::bit_cast<double>(b[t][i]));
    }
  }
  return "";
}

}  // namespace meshrepair
