// SPDX-License-Identifier: MIT
// What is said of what a format has no place for.
#include <gmock/gmock.h>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <mesh/lost_attributes.h>
#include <mesh/soup_io.h>

#include "small_pictures.h"

namespace meshrepair {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Wrap = TextureSampling::Wrap;

using Words = std::vector<std::string>;

// A triangle with a picture, and with colours of its corners.
struct Painted {
  TriangleSoup soup{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  Attributes attributes;

  Painted() {
    CornerAttribute places;
    places.values = {0, 0, 1, 0, 0, 1};
    places.of_corner = {0, 1, 2};
    attributes.corners.push_back(places);
    attributes.materials = {{"paint"}, {0}};
    attributes.images.push_back(
        {"a.png", "image/png", "", std::make_shared<const std::string>(one_pixel_png(1, 2, 3))});
    attributes.looks.push_back({.image = 0});
  }

  void add_colours(double opacity) {
    CornerAttribute colours;
    colours.kind = CornerAttribute::Kind::colour;
    colours.components = 4;
    colours.values = {1, 0, 0, opacity};
    colours.of_corner = {0, 0, 0};
    attributes.corners.push_back(colours);
  }

  [[nodiscard]] Words lost_in(SoupFormat format) const {
    return lost_attributes(soup, attributes, held_by(format, attributes), format);
  }
};

constexpr auto kPictureFormats = {SoupFormat::obj, SoupFormat::glb, SoupFormat::gltf,
                                  SoupFormat::threemf};

TEST(LostAttributes, PlyHasNoColoursOfMaterialsAndNoPicturesInIt) {
  Painted mesh;
  EXPECT_THAT(mesh.lost_in(SoupFormat::ply_binary), ElementsAre("pictures that are no files"));
  mesh.attributes.looks[0].colour[1] = 0.5;
  EXPECT_THAT(mesh.lost_in(SoupFormat::ply_ascii),
              ElementsAre("colours of materials", "pictures that are no files"));
  for (const SoupFormat format : kPictureFormats) EXPECT_THAT(mesh.lost_in(format), IsEmpty());
  mesh.attributes.images[0] = {"a.png", "", "/somewhere/a.png", nullptr};
  mesh.attributes.looks[0].colour[1] = 1;
  EXPECT_THAT(mesh.lost_in(SoupFormat::ply_ascii), IsEmpty());
}

TEST(LostAttributes, PackagesHoldPicturesThatAreThereInTwoFormats) {
  Painted mesh;
  const auto bytes_of = [](const char* text) { return std::make_shared<const std::string>(text); };
  const auto lost = ElementsAre("pictures that are not there, or neither PNG nor JPEG",
                                "texture coordinates where there is no picture");
  mesh.attributes.images[0] = {"a.webp", "image/webp", "", bytes_of("RIFF")};
  EXPECT_THAT(mesh.lost_in(SoupFormat::threemf), lost);
  mesh.attributes.images[0] = {"a.png", "", "/nowhere/a.png", nullptr};
  EXPECT_THAT(mesh.lost_in(SoupFormat::threemf), lost);
  EXPECT_THAT(mesh.lost_in(SoupFormat::glb), IsEmpty());
  mesh.attributes.images[0] = {"a.jpg", "", "", bytes_of("\xFF\xD8\xFF")};
  EXPECT_THAT(mesh.lost_in(SoupFormat::threemf), IsEmpty());
}

TEST(LostAttributes, ObjAndStlHaveNoOpacityOfColours) {
  for (const double opacity : {1.0, 0.5}) {
    Painted mesh;
    mesh.add_colours(opacity);
    const Words opacity_lost = opacity == 1 ? Words() : Words{"opacity of colours"};
    EXPECT_EQ(mesh.lost_in(SoupFormat::obj), opacity_lost);
    mesh.attributes.corners.erase(mesh.attributes.corners.begin());
    mesh.attributes.materials = {};
    EXPECT_EQ(mesh.lost_in(SoupFormat::stl_binary), opacity_lost);
    EXPECT_THAT(mesh.lost_in(SoupFormat::ply_binary), IsEmpty());
    EXPECT_THAT(mesh.lost_in(SoupFormat::glb), IsEmpty());
  }
}

TEST(LostAttributes, WhatIsLostIsSaidOnce) {
  Painted mesh;
  mesh.attributes.corners.push_back(mesh.attributes.corners[0]);
  mesh.attributes.looks[0].image = kNone;
  EXPECT_THAT(mesh.lost_in(SoupFormat::threemf), ElementsAre("texture coordinates"));
}

// Each way of laying a picture, with the formats that cannot say it; the others bring it back.
TEST(LostAttributes, LayingOfPicturesComesBackOrIsSaid) {
  using Filter = TextureSampling::Filter;
  struct Case {
    TextureSampling sampling;
    std::vector<SoupFormat> missing;
  };
  const std::vector<Case> cases = {
      {{{Wrap::repeat, Wrap::repeat}, Filter::automatic}, {}},
      {{{Wrap::clamp, Wrap::clamp}, Filter::automatic}, {}},
      {{{Wrap::mirror, Wrap::repeat}, Filter::automatic}, {SoupFormat::obj}},
      {{{Wrap::repeat, Wrap::clamp}, Filter::automatic}, {SoupFormat::obj}},
      {{{Wrap::none, Wrap::none}, Filter::automatic},
       {SoupFormat::obj, SoupFormat::glb, SoupFormat::gltf}},
      {{{Wrap::repeat, Wrap::repeat}, Filter::nearest}, {SoupFormat::obj}}};
  for (const auto& [sampling, missing] : cases) {
    Painted mesh;
    mesh.attributes.looks[0].sampling = sampling;
    for (const SoupFormat format : kPictureFormats) {
      const bool is_missing = std::find(missing.begin(), missing.end(), format) != missing.end();
      EXPECT_EQ(mesh.lost_in(format).size(), is_missing ? 1u : 0u) << format_name(format);
      if (is_missing || format == SoupFormat::obj) continue;
      const std::string bytes = format_soup(mesh.soup, format, {.attributes = &mesh.attributes});
      ReadOptions options;
      options.attributes = true;
      const ReadResult back = read_soup(std::string_view(bytes), "a", options);
      ASSERT_EQ(back.attributes.looks.size(), 1u);
      EXPECT_EQ(back.attributes.looks[0].sampling, sampling) << format_name(format);
    }
  }
}

// Of one picture, once repeated and once not.
TEST(LostAttributes, OnePictureIsLaidInTwoWays) {
  Painted mesh;
  mesh.soup.triangles.push_back({0, 2, 1});
  mesh.attributes.corners[0].of_corner = {0, 1, 2, 0, 2, 1};
  mesh.attributes.materials = {{"paint", "paper"}, {0, 1}};
  mesh.attributes.looks.push_back({.image = 0, .sampling = {{Wrap::mirror, Wrap::clamp}}});
  for (const SoupFormat format : {SoupFormat::glb, SoupFormat::threemf}) {
    const std::string bytes = format_soup(mesh.soup, format, {.attributes = &mesh.attributes});
    ReadOptions options;
    options.attributes = true;
    const ReadResult back = read_soup(std::string_view(bytes), "a", options);
    const auto& [names, of_triangle] = back.attributes.materials;
    ASSERT_EQ(of_triangle.size(), 2u);
    EXPECT_EQ(back.attributes.images.size(), 1u);
    for (std::size_t t = 0; t < 2; ++t) {
      EXPECT_EQ(names.at(of_triangle[t]), mesh.attributes.materials.names[t]);
      EXPECT_EQ(back.attributes.looks.at(of_triangle[t]).sampling,
                mesh.attributes.looks[t].sampling);
    }
  }
}

}  // namespace
}  // namespace meshrepair
