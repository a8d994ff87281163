// SPDX-License-Identifier: MIT
// Textured solids that are written to files and read, and what has to hold of what was made of
// them.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <mesh/soup_io.h>

#include "small_pictures.h"
#include "textured.h"
#include "textured_surface.h"
#include "triangles_by_place.h"

namespace meshrepair::testing {

// A format, and what it has of colours.
struct FileFormat {
  SoupFormat format;
  std::string extension;
  bool one_colour_at_a_point;  // not one for each corner
  double colour_bound;         // half of its last step, and something

  [[nodiscard]] ValueBounds bounds() const { return {1e-6, colour_bound}; }
};

inline std::vector<FileFormat> formats_of_files() {
  constexpr double kHalfAByte = 0.5 / 255 + 1e-6;
  return {{SoupFormat::obj, ".obj", true, 1e-6},
          {SoupFormat::ply_binary, ".ply", true, 1e-6},
          {SoupFormat::ply_ascii, ".ply", true, 1e-6},
          {SoupFormat::glb, ".glb", false, 1e-6},
          {SoupFormat::gltf, ".gltf", false, 1e-6},
          {SoupFormat::threemf, ".3mf", false, kHalfAByte}};
}

inline std::string name_of_case(const ::testing::TestParamInfo<FileFormat>& tested) {
  std::string name(format_name(tested.param.format));
  std::erase(name, ' ');
  return name;
}

inline void PrintTo(const FileFormat& file, std::ostream* out) {  // NOLINT: GoogleTest's name
  *out << format_name(file.format);
}

// In single precision. Where a format has one colour for each point, all solids have to agree on it
// wherever they meet: it is a linear function of the place.
inline CornerAttribute bright_colours_of(const TriangleSoup& soup, bool linear) {
  CornerAttribute colours = colours_of(soup);
  colours.storage = CornerAttribute::Storage::real32;
  for (std::size_t i = 0; i < colours.values.size(); ++i) {
    const Vec3d& at = soup.points[i / 3];
    const double place = at[static_cast<int>(i % 3)] + 0.25 * at.sum();
    colours.values[i] = as_single(linear ? 0.5 + 0.1 * place : 0.5 + 0.4 * std::sin(3 * place));
  }
  return colours;
}

// One material, with a picture: 3MF has no places in pictures without one.
inline TexturedSoup textured_solid(const TriangleSoup& solid, const std::string& material,
                                   bool linear_colours) {
  TexturedSoup made{solid, {}};
  made.attributes.corners = {texture_of(solid), normals_of(solid),
                             bright_colours_of(solid, linear_colours)};
  made.attributes.materials.names = {material};
  made.attributes.materials.of_triangle.assign(solid.triangles.size(), 0);
  made.attributes.looks = {{{1, 1, 1, 1}, 0}};
  const auto level = static_cast<std::uint8_t>(material.size());
  auto bytes = std::make_shared<const std::string>(one_pixel_png(level, 0, 0));
  made.attributes.images = {{material + ".png", "image/png", "", std::move(bytes)}};
  return made;
}

// Written to the file, and read from there.
inline TexturedSoup through_file(const std::filesystem::path& path, const TriangleSoup& soup,
                                 const Attributes& attributes, SoupFormat format) {
  const Attributes held = held_by(format, attributes);
  WriteOptions writing;
  writing.format = format;
  writing.extras.attributes = &held;
  write_soup(soup, path, writing);
  ReadOptions reading;
  reading.attributes = true;
  ReadResult result = read_soup(path, reading);
  EXPECT_TRUE(result.report.warnings.empty());
  return {std::move(result.soup), std::move(result.attributes)};
}

// Of a corner its values in bits, and the material of its triangle.
inline std::pair<std::vector<std::uint64_t>, std::string> facts_of_corner(
    const Attributes& attributes, CornerAttribute::Kind kind, std::size_t corner) {
  std::vector<std::uint64_t> bits;
  const CornerAttribute* const set = find_kind(attributes, kind);
  if (set != nullptr && set->of_corner[corner] != kNone) {
    for (std::size_t i = 0; i < std::min<std::size_t>(set->components, 3); ++i) {
      const double value = set->values[set->components * set->of_corner[corner] + i];
      bits.push_back(std::bit_cast<std::uint64_t>(value));
    }
  }
  const TriangleLabels& materials = attributes.materials;
  return {bits, materials.names.at(materials.of_triangle.at(corner / 3))};
}

// Whatever lies where a triangle of the input lies, in whatever order files have them.
inline void expect_whole_triangles_by_place(const TexturedSoup& input, const TexturedSoup& result) {
  std::map<PlacedTriangle, std::size_t> given;
  for (std::size_t t = 0; t < input.soup.triangles.size(); ++t) {
    given.emplace(placed_triangle(input.soup, t), t);
  }
  using CornerKind = CornerAttribute::Kind;
  std::size_t whole = 0;
  for (std::size_t t = 0; t < result.soup.triangles.size(); ++t) {
    const auto found = given.find(placed_triangle(result.soup, t));
    if (found == given.end()) continue;
    ++whole;
    const std::size_t s = found->second;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d& at = result.soup.points[result.soup.triangles[t][k]];
      std::size_t from = 0;
      while (input.soup.points[input.soup.triangles[s][from]] != at) ++from;
      for (const CornerKind kind : {CornerKind::texture, CornerKind::colour}) {
        ASSERT_EQ(facts_of_corner(result.attributes, kind, 3 * t + k),
                  facts_of_corner(input.attributes, kind, 3 * s + from));
      }
    }
  }
  EXPECT_GT(whole, input.soup.triangles.size() / 3);
}

}  // namespace meshrepair::testing
