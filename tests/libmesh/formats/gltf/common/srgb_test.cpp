// SPDX-License-Identifier: MIT
// Colours of screens and of light.
#include "formats/gltf/common/srgb.h"

#include <cmath>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include <mesh/soup_io.h>

#include "soup_fixtures.h"

namespace meshrepair {
namespace {

TEST(Srgb, FollowsTheStandard) {
  EXPECT_DOUBLE_EQ(linear_of_srgb(0.04), 0.04 / 12.92);
  EXPECT_DOUBLE_EQ(linear_of_srgb(0.5), std::pow(0.555 / 1.055, 2.4));
  EXPECT_NEAR(linear_of_srgb(188 / 255.0), 0.5028864580325687, 1e-15);
  EXPECT_NEAR(srgb_of_linear(0.5), 0.7353569830524495, 1e-15);
  EXPECT_DOUBLE_EQ(srgb_of_linear(0.003), 12.92 * 0.003);
}

TEST(Srgb, ComesBackInEveryByte) {
  for (int byte = 0; byte < 256; ++byte) {
    const double value = byte / 255.0;
    EXPECT_NEAR(srgb_of_linear(linear_of_srgb(value)), value, 1e-15);
    EXPECT_EQ(std::lround(255 * srgb_of_linear(linear_of_srgb(value))), byte);
  }
}

TEST(Srgb, LeavesWhatIsNoShare) {
  for (const double value : {0.0, 1.0, -0.5, 2.0}) {
    EXPECT_EQ(linear_of_srgb(value), value);
    EXPECT_EQ(srgb_of_linear(value), value);
  }
  EXPECT_TRUE(std::isnan(linear_of_srgb(std::nan(""))));
}

// glTF has factors of light, the other formats colours of screens.
TEST(Srgb, ColoursOfMaterialsLookTheSameInAllFormats) {
  TriangleSoup soup{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  Attributes attributes;
  attributes.materials = {{"paint"}, {0}};
  attributes.looks.push_back({.colour = {188 / 255.0, 0, 1, 0.5}});
  const std::string text = format_soup(soup, SoupFormat::gltf, {.attributes = &attributes});
  EXPECT_NE(text.find("[0.502886458032568"), std::string::npos) << text;
  ReadOptions options;
  options.attributes = true;
  ReadResult read = read_soup(std::string_view(text), "a.gltf", options);
  ASSERT_EQ(read.attributes.looks.size(), 1u);
  EXPECT_NEAR(read.attributes.looks[0].colour[0], 188 / 255.0, 1e-15);
  EXPECT_EQ(read.attributes.looks[0].colour[3], 0.5);
  const std::string package =
      format_soup(soup, SoupFormat::threemf, {.attributes = &read.attributes});
  const ReadResult back = read_soup(std::string_view(package), "a.3mf", options);
  EXPECT_EQ(back.attributes.looks.at(0).colour[0], 188 / 255.0);
}

// What was read as glTF stays as it was, bit for bit.
TEST(Srgb, DoesNotChangeAGltf) {
  TriangleSoup soup{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  Attributes attributes;
  attributes.materials = {{"paint"}, {0}};
  attributes.looks.push_back({.colour = {0.3, 0.6, 0.9, 1}});
  const std::string text = format_soup(soup, SoupFormat::gltf, {.attributes = &attributes});
  ReadOptions options;
  options.attributes = true;
  const ReadResult read = read_soup(std::string_view(text), "a.gltf", options);
  const auto factor_in = [](const std::string& json) {
    const std::size_t first = json.find("\"baseColorFactor\":[");
    return json.substr(first, json.find(']', first) - first);
  };
  EXPECT_EQ(factor_in(format_soup(soup, SoupFormat::gltf, {.attributes = &read.attributes})),
            factor_in(text));
  EXPECT_FALSE(factor_in(text).empty());
}

}  // namespace
}  // namespace meshrepair
