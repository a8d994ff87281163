// SPDX-License-Identifier: MIT
// Pictures lie where the first set of texture coordinates says, whatever the materials said.
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <mesh/placed_pictures.h>
#include <mesh/soup_io.h>

#include "small_pictures.h"

namespace meshrepair {
namespace {

// Two triangles with a material each, and two sets of coordinates.
struct Pictured {
  TriangleSoup soup;
  Attributes attributes;

  Pictured() {
    soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    soup.triangles = {{0, 1, 2}, {0, 3, 1}};
    for (const double first : {0.0, 0.5}) {
      CornerAttribute set;
      set.values = {first, 0, first + 0.25, 0.125, first, 0.25};
      set.of_corner = {0, 1, 2, 2, 1, 0};
      attributes.corners.push_back(set);
    }
    attributes.materials = {{"one", "two"}, {0, 1}};
    attributes.looks.resize(2);
    attributes.looks[0].image = attributes.looks[1].image = 0;
    attributes.images.push_back(
        {"a.png", "image/png", "", std::make_shared<const std::string>(one_pixel_png(1, 2, 3))});
  }
};

std::array<double, 2> place_at(const Attributes& attributes, std::size_t corner) {
  const CornerAttribute& places = attributes.corners.at(0);
  const double* const value = places.values.data() + 2 * places.of_corner.at(corner);
  return {value[0], value[1]};
}

void expect_near(const std::array<double, 2>& a, const std::array<double, 2>& b) {
  EXPECT_NEAR(a[0], b[0], 1e-7);
  EXPECT_NEAR(a[1], b[1], 1e-7);
}

TEST(PlacedPictures, PicturesOfTheFirstSetStayAsTheyAre) {
  Pictured mesh;
  EXPECT_FALSE(with_placed_pictures(mesh.attributes));
  // Nothing lies where there is no picture.
  mesh.attributes.looks[1] = {.texture_set = 1};
  EXPECT_FALSE(with_placed_pictures(mesh.attributes));
}

TEST(PlacedPictures, TakeEachTheirOwnSet) {
  Pictured mesh;
  mesh.attributes.looks[1].texture_set = 1;
  const std::optional<Attributes> placed = with_placed_pictures(mesh.attributes);
  ASSERT_TRUE(placed);
  EXPECT_EQ(placed->corners.size(), 3u);
  EXPECT_EQ(placed->looks[1].texture_set, 0u);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(place_at(*placed, k), place_at(mesh.attributes, k));
    EXPECT_EQ(place_at(*placed, 3 + k)[0], place_at(mesh.attributes, 3 + k)[0] + 0.5);
  }
  EXPECT_FALSE(with_placed_pictures(*placed));
}

TEST(PlacedPictures, OfASetThatIsNotThereHaveNoPlace) {
  Pictured mesh;
  mesh.attributes.looks[1].texture_set = 7;
  const std::optional<Attributes> placed = with_placed_pictures(mesh.attributes);
  ASSERT_TRUE(placed);
  EXPECT_EQ(placed->corners[0].of_corner[3], kNone);
  EXPECT_NE(placed->corners[0].of_corner[0], kNone);
}

// A quarter turn counterclockwise of the coordinates, seen with v downwards: u becomes v, and v
// becomes -u.
TEST(PlacedPictures, AreScaledThenTurnedThenMoved) {
  Pictured mesh;
  mesh.attributes.looks[0].transform = {
      .offset = {0.5, 0.25}, .scale = {2, 3}, .rotation = std::numbers::pi / 2};
  const std::optional<Attributes> placed = with_placed_pictures(mesh.attributes);
  ASSERT_TRUE(placed);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [u, v] = place_at(mesh.attributes, k);
    expect_near(place_at(*placed, k), {3 * (1 - v) + 0.5, 1 - (-2 * u + 0.25)});
    EXPECT_EQ(place_at(*placed, 3 + k), place_at(mesh.attributes, 3 + k));
  }
}

// Also where the format does not hold the set that the picture lies by.
TEST(PlacedPictures, AreWhatAFormatWithOneSetHolds) {
  Pictured mesh;
  mesh.attributes.looks[0].texture_set = mesh.attributes.looks[1].texture_set = 1;
  for (const SoupFormat format : {SoupFormat::obj, SoupFormat::threemf}) {
    const Attributes held = held_by(format, mesh.attributes);
    ASSERT_EQ(held.corners.size(), 1u);
    for (std::size_t k = 0; k < 6; ++k) {
      EXPECT_EQ(place_at(held, k)[0], place_at(mesh.attributes, k)[0] + 0.5);
    }
  }
}

TEST(PlacedPictures, LieAsTheyDidInEveryFormatThatHoldsThem) {
  Pictured mesh;
  mesh.attributes.looks[0].transform = {.offset = {0.5, 0.25}, .scale = {2, 3}, .rotation = 1};
  mesh.attributes.looks[1].texture_set = 1;
  const std::optional<Attributes> wanted = with_placed_pictures(mesh.attributes);
  ASSERT_TRUE(wanted);
  for (const SoupFormat format : {SoupFormat::obj, SoupFormat::ply_binary, SoupFormat::glb,
                                  SoupFormat::gltf, SoupFormat::threemf}) {
    const std::string bytes = format_soup(mesh.soup, format, {.attributes = &mesh.attributes});
    const ReadResult read = read_soup(bytes, "mesh", {.attributes = true});
    const auto placed = with_placed_pictures(read.attributes);
    const Attributes& seen = placed ? *placed : read.attributes;
    for (std::size_t t = 0; t < 2; ++t) {
      // Formats have the triangles in an order of their own.
      const bool is_first = (read.soup.points[read.soup.triangles[t][2]] - Vec3d(0, 1, 0)).isZero();
      for (std::size_t k = 0; k < 3; ++k) {
        expect_near(place_at(seen, 3 * t + k), place_at(*wanted, (is_first ? 0 : 3) + k));
      }
    }
  }
}

}  // namespace
}  // namespace meshrepair
