// SPDX-License-Identifier: MIT
// Soups with attributes, for tests.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <base/ids.h>
#include <mesh/attributes.h>
#include <mesh/soup.h>

#include "shapes.h"

namespace meshrepair::testing {

struct TexturedSoup {
  TriangleSoup soup;
  Attributes attributes;
};

// Numbers that single precision holds.
inline double as_single(double x) { return static_cast<double>(static_cast<float>(x)); }

// Texture coordinates that bend with the place, in charts: seams are where triangles of different
// eighths of space around the origin meet.
inline CornerAttribute texture_of(const TriangleSoup& soup) {
  CornerAttribute texture;
  texture.kind = CornerAttribute::Kind::texture;
  texture.storage = CornerAttribute::Storage::real32;
  std::map<std::pair<std::uint32_t, int>, std::uint32_t> known;
  for (const auto& t : soup.triangles) {
    const Vec3d middle = soup.points[t[0]] + soup.points[t[1]] + soup.points[t[2]];
    const int chart = (middle.x() > 0 ? 1 : 0) + (middle.y() > 0 ? 2 : 0);
    for (const std::uint32_t p : t) {
      const auto next = static_cast<std::uint32_t>(known.size());
      const auto [found, is_new] = known.try_emplace({p, chart}, next);
      if (is_new) {
        const Vec3d& at = soup.points[p];
        texture.values.push_back(as_single(0.25 * chart + 0.1 * std::sin(at.x()) + 0.05 * at.z()));
        texture.values.push_back(as_single(0.1 * at.y() * at.y() + 0.1 * at.z()));
      }
      texture.of_corner.push_back(found->second);
    }
  }
  return texture;
}

// One for each point, as of a sphere around the origin.
inline CornerAttribute normals_of(const TriangleSoup& soup) {
  CornerAttribute normals;
  normals.kind = CornerAttribute::Kind::normal;
  normals.place = CornerAttribute::Place::point;
  normals.storage = CornerAttribute::Storage::real32;
  normals.components = 3;
  for (const Vec3d& p : soup.points) {
    const Vec3d n = p.norm() > 0 ? p.normalized() : Vec3d(0, 0, 1);
    for (int i = 0; i < 3; ++i) normals.values.push_back(as_single(n[i]));
  }
  for (const auto& t : soup.triangles) {
    normals.of_corner.insert(normals.of_corner.end(), t.begin(), t.end());
  }
  return normals;
}

// One for each point, in bytes.
inline CornerAttribute colours_of(const TriangleSoup& soup) {
  CornerAttribute colours;
  colours.kind = CornerAttribute::Kind::colour;
  colours.place = CornerAttribute::Place::point;
  colours.storage = CornerAttribute::Storage::byte;
  colours.components = 3;
  for (std::size_t p = 0; p < soup.points.size(); ++p) {
    for (std::size_t i = 0; i < 3; ++i) {
      colours.values.push_back(static_cast<double>((p * 37 + i * 101) % 256) / 255);
    }
  }
  for (const auto& t : soup.triangles) {
    colours.of_corner.insert(colours.of_corner.end(), t.begin(), t.end());
  }
  return colours;
}

// Triangle t has the name of number of[t].
inline TriangleLabels labels_of(std::vector<std::string> names, std::vector<std::uint32_t> of) {
  return {std::move(names), std::move(of)};
}

// With everything, one material and group for each of `parts` soups.
inline TexturedSoup textured(const std::vector<TriangleSoup>& parts) {
  TexturedSoup result;
  TriangleLabels materials;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    append(result.soup, parts[i]);
    materials.names.push_back("material " + std::to_string(i));
    materials.of_triangle.resize(result.soup.triangles.size(), static_cast<std::uint32_t>(i));
  }
  result.attributes.corners = {texture_of(result.soup), normals_of(result.soup),
                               colours_of(result.soup)};
  result.attributes.materials = materials;
  for (std::string& name : materials.names) name += "_group";
  result.attributes.groups = std::move(materials);
  return result;
}

// Of each corner its value, in bits; {} where it has none.
inline std::vector<std::vector<std::uint64_t>> value_bits(const CornerAttribute& attribute) {
  std::vector<std::vector<std::uint64_t>> bits;
  for (const std::uint32_t value : attribute.of_corner) {
    auto& of_corner = bits.emplace_back();
    if (value == kNone) continue;
    for (std::size_t i = 0; i < attribute.components; ++i) {
      of_corner.push_back(
          std::bit_cast<std::uint64_t>(attribute.values[attribute.components * value + i]));
    }
  }
  return bits;
}

// Of each triangle its name, or "-".
inline std::vector<std::string> names_of(const TriangleLabels& labels) {
  std::vector<std::string> names;
  for (const std::uint32_t label : labels.of_triangle) {
    names.push_back(label == kNone ? "-" : labels.names[label]);
  }
  return names;
}

}  // namespace meshrepair::testing
