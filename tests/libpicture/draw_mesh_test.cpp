// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <base/error.h>
#include <base/ids.h>
#include <base/parallel.h>
#include <picture/draw_mesh.h>
#include <picture/png_io.h>

#include "shapes.h"
#include "textured.h"

namespace meshrepair {
namespace {

constexpr Rgba kWhite = {255, 255, 255, 255};

Pixels draw(const TriangleSoup& soup, PictureSize size, const std::string& view = "iso",
            const Attributes& attributes = {}, const DrawOptions& options = {}) {
  Textures textures;
  const Camera camera(*view_of(view), size, {&soup});
  return draw_mesh(soup, attributes, camera, textures, options);
}

bool is_red(const Rgba& c) { return c[0] > 2 * c[1] && c[0] > 2 * c[2]; }

std::size_t count_if_pixel(const Pixels& pixels, bool (*condition)(const Rgba&)) {
  return static_cast<std::size_t>(
      std::count_if(pixels.values.begin(), pixels.values.end(), condition));
}

// A square in the plane y = 0, seen from the front, with a texture spread over it once.
testing::TexturedSoup square(const Pixels& texture) {
  testing::TexturedSoup square;
  square.soup = {{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}, {{0, 1, 2}, {0, 2, 3}}};
  CornerAttribute places;
  places.values = {0, 0, 1, 0, 1, 1, 0, 1};
  places.of_corner = {0, 1, 2, 0, 2, 3};
  square.attributes.corners = {places};
  square.attributes.materials = {{"m"}, {0, 0}};
  square.attributes.looks = {{{1, 1, 1, 1}, 0}};
  square.attributes.images = {
      {"t.png", "", "", std::make_shared<const std::string>(format_png(texture))}};
  return square;
}

std::uint64_t hash_of(const Pixels& pixels) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const Rgba& value : pixels.values) {
    for (const std::uint8_t byte : value) hash = (hash ^ byte) * 0x100000001b3;
  }
  return hash;
}

TEST(DrawMesh, OfNothingIsBackground) {
  DrawOptions options;
  options.background = {1, 2, 3, 4};
  EXPECT_EQ(draw({}, {7, 5}, "iso", {}, options), filled({7, 5}, {1, 2, 3, 4}));
}

TEST(DrawMesh, TakesAnySizeAndAnyNumberOfSamples) {
  const TriangleSoup soup = testing::sphere(300);
  for (const PictureSize size :
       {PictureSize{1, 1}, {1, 50}, {50, 1}, {7, 3}, {1000, 2}, {2, 1000}}) {
    for (const unsigned samples : {1U, 2U, 3U, 8U}) {
      DrawOptions options;
      options.samples = samples;
      const Pixels pixels = draw(soup, size, "iso", {}, options);
      EXPECT_EQ(pixels.values.size(), size.pixels());
      if (samples > 2) {
        EXPECT_FALSE(pixels == filled(size, kWhite));
      }
    }
  }
  DrawOptions options;
  options.samples = 9;
  EXPECT_THROW((void)draw(soup, {5, 5}, "iso", {}, options), UsageError);
  options.samples = 0;
  EXPECT_THROW((void)draw(soup, {5, 5}, "iso", {}, options), UsageError);
}

TEST(DrawMesh, ScaleDoesNotMatter) {
  const TriangleSoup soup = testing::torus(24, 12);
  const Pixels pixels = draw(soup, {60, 40});
  for (const double power : {0x1p900, 0x1p-900, 0x1p1020, 0x1p-1000}) {
    EXPECT_EQ(draw(testing::scaled(soup, power), {60, 40}), pixels) << power;
  }
  EXPECT_GT(count_if_pixel(draw(testing::scaled(soup, 1e300), {60, 40}),
                           [](const Rgba& c) { return c != kWhite; }),
            500U);
}

TEST(DrawMesh, TrianglesThatAreNotFiniteAreLeftOut) {
  TriangleSoup soup = testing::cube();
  const Pixels pixels = draw(soup, {40, 40});
  const double inf = std::numeric_limits<double>::infinity();
  for (const double bad : {inf, -inf, std::nan("")}) {
    const auto at = static_cast<std::uint32_t>(soup.points.size());
    soup.points.push_back({0, bad, 0});
    soup.triangles.push_back({0, 1, at});
    soup.triangles.push_back({at, at, at});
  }
  EXPECT_EQ(draw(soup, {40, 40}), pixels);
}

TEST(DrawMesh, DegenerateTrianglesAreNotSeen) {
  TriangleSoup soup = testing::cube();
  const Pixels pixels = draw(soup, {40, 40});
  soup.triangles.push_back({0, 0, 1});
  soup.triangles.push_back({3, 3, 3});
  EXPECT_EQ(draw(soup, {40, 40}), pixels);
  EXPECT_NO_THROW((void)draw({{{1, 2, 3}}, {{0, 0, 0}}}, {4, 4}));
  EXPECT_NO_THROW((void)draw({{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, {{0, 1, 2}}}, {4, 4}));
}

TEST(DrawMesh, WhatIsSeenFromBehindIsRed) {
  const TriangleSoup whole = testing::sphere(2000);
  EXPECT_EQ(count_if_pixel(draw(whole, {80, 80}), is_red), 0U);
  EXPECT_GT(count_if_pixel(draw(testing::flipped(whole), {80, 80}), is_red), 3000U);
  TriangleSoup open = whole;
  std::erase_if(open.triangles, [&](const auto& t) { return open.points[t[0]].z() > 0.5; });
  EXPECT_GT(count_if_pixel(draw(open, {80, 80}, "top"), is_red), 500U);
}

TEST(DrawMesh, TheOrderOfTrianglesAndCornersDoesNotMatter) {
  const TriangleSoup soup = testing::noisy_sphere(800, 0.2, 3);
  TriangleSoup reversed = soup;
  std::reverse(reversed.triangles.begin(), reversed.triangles.end());
  EXPECT_EQ(draw(reversed, {60, 60}), draw(soup, {60, 60}));
}

TEST(DrawMesh, ThreadsDoNotMatter) {
  const TriangleSoup soup = testing::noisy_sphere(3000, 0.2, 3);
  const Pixels pixels = draw(soup, {200, 150});
  const ThreadLimit one(1);
  EXPECT_EQ(draw(soup, {200, 150}), pixels);
}

// The pixels are those of any compiler, with any options.
TEST(DrawMesh, PixelsAreTheSameEverywhere) {
  Pixels texture;
  texture.size = {13, 9};
  for (unsigned i = 0; i < 13 * 9; ++i) {
    const auto byte = [](unsigned value) { return static_cast<std::uint8_t>(value); };
    texture.values.push_back({byte(i * 37), byte(i * 101), byte(i * 59), 255});
  }
  const auto [soup, attributes] = square(texture);
  const std::vector<std::pair<std::string, std::uint64_t>> cases = {
      {"17,-23", 5441053095625458904U},
      {"iso", 246753085587345900U},
      {"front", 17245008827968901558U}};
  for (const auto& [view, hash] : cases) {
    EXPECT_EQ(hash_of(draw(soup, {60, 45}, view, attributes)), hash) << view;
  }
  TriangleSoup grid;  // whole numbers: shapes of sines differ between C libraries
  for (int i = 0; i < 400; ++i) {
    grid.points.emplace_back(i * 7919 % 1013, i * 104729 % 997, i * 1299709 % 991);
  }
  for (std::uint32_t i = 0; i < 398; ++i) grid.triangles.push_back({i, i + 1, i + 2});
  EXPECT_EQ(hash_of(draw(grid, {60, 45}, "12.5,33")), 15515984877637720792U);
}

TEST(DrawMesh, TexturesStandAsInTheirPictures) {
  const Rgba red = {255, 0, 0, 255}, green = {0, 255, 0, 255}, blue = {0, 0, 255, 255};
  const auto [soup, attributes] = square({{2, 2}, {red, green, blue, kWhite}});
  const Pixels pixels = draw(soup, {40, 40}, "front", attributes);
  const auto strongest = [&](std::size_t x, std::size_t y) {
    const Rgba& c = pixels.at(x, y);
    return std::max_element(c.begin(), c.begin() + 3) - c.begin();
  };
  EXPECT_EQ(strongest(10, 10), 0);
  EXPECT_EQ(strongest(30, 10), 1);
  EXPECT_EQ(strongest(10, 30), 2);
  EXPECT_NEAR(pixels.at(30, 30)[0], pixels.at(30, 30)[2], 10);
}

TEST(DrawMesh, BrokenTexturesLeaveTheColourOfTheMaterial) {
  auto [soup, attributes] = square(filled({2, 2}, kWhite));
  attributes.images[0].bytes = std::make_shared<const std::string>("no picture");
  attributes.looks[0].colour = {0, 1, 0, 1};
  const Pixels pixels = draw(soup, {20, 20}, "front", attributes);
  EXPECT_EQ(pixels.at(10, 10)[0], 0);
  EXPECT_GT(pixels.at(10, 10)[1], 150);
}

TEST(DrawMesh, ColoursOfCornersAreMixedAndMultiplyTheMaterial) {
  TriangleSoup soup{{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, {{0, 1, 2}}};
  Attributes attributes;
  CornerAttribute colours;
  colours.kind = CornerAttribute::Kind::colour;
  colours.components = 3;
  colours.values = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  colours.of_corner = {0, 1, 2};
  attributes.corners = {colours};
  const Pixels pixels = draw(soup, {60, 60}, "front", attributes);
  EXPECT_GT(pixels.at(4, 54)[0], 150);  // lower left
  EXPECT_LT(pixels.at(4, 54)[1], 30);
  EXPECT_GT(pixels.at(52, 55)[1], 150);
  EXPECT_GT(pixels.at(4, 8)[2], 150);
  attributes.materials = {{"m"}, {0}};
  attributes.looks = {{{1, 1, 0, 1}, kNone}};
  EXPECT_EQ(draw(soup, {60, 60}, "front", attributes).at(4, 8)[2], 0);
}

TEST(DrawMesh, ColoursThatAreAllBlackAreNone) {
  testing::TexturedSoup cube = testing::textured({testing::cube()});
  for (double& value : cube.attributes.corners[2].values) value = 0;
  EXPECT_EQ(draw(cube.soup, {20, 20}, "iso", cube.attributes), draw(cube.soup, {20, 20}));
}

TEST(DrawMesh, AttributesThatAreNoNumbersAreTaken) {
  auto [soup, attributes] = square(filled({2, 2}, kWhite));
  attributes.corners[0].values = {std::nan(""), 1e300, -1e300, 0, 1e308, -1e308, 0, 1};
  attributes.looks[0].colour = {std::nan(""), -5, 1e300, 1};
  const Pixels pixels = draw(soup, {20, 20}, "front", attributes);
  EXPECT_EQ(pixels.at(10, 10)[0], 0);
  attributes.materials.of_triangle = {7, kNone};  // none of these is there
  EXPECT_NO_THROW((void)draw(soup, {20, 20}, "front", attributes));
}

TEST(DrawMesh, EdgesOverATransparentBackgroundAreTransparentInPart) {
  DrawOptions options;
  options.background = {0, 0, 0, 0};
  const Pixels pixels = draw(testing::sphere(500), {40, 40}, "iso", {}, options);
  EXPECT_EQ(pixels.at(0, 0)[3], 0);
  EXPECT_EQ(pixels.at(20, 20)[3], 255);
  std::size_t between = 0;
  for (const Rgba& value : pixels.values) {
    between += value[3] > 0 && value[3] < 255;
    ASSERT_TRUE(value[3] == 0 || value[2] > 40);  // not darkened by what is behind
  }
  EXPECT_GT(between, 50U);
}

TEST(DrawMesh, StopsWhenTold) {
  struct Stop : ProgressObserver {
    bool cancelled() override { return true; }
  } stop;
  DrawOptions options;
  options.progress = &stop;
  EXPECT_THROW((void)draw(testing::cube(), {50, 50}, "iso", {}, options), Cancelled);
}

}  // namespace
}  // namespace meshrepair
