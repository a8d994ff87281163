// SPDX-License-Identifier: MIT
// Attributes come back bit for bit from every format that holds them.
#include <algorithm>
#include <cstring>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <mesh/soup_io.h>

#include "each_seed.h"
#include "soup_fixtures.h"
#include "textured.h"
#include "warning_texts.h"

namespace meshrepair {
namespace {

using namespace testing;
using Kind = CornerAttribute::Kind;

ReadResult parse_with_attributes(const std::string& bytes) {
  ReadOptions options;
  options.attributes = true;
  return read_soup(bytes, "mesh", options);
}

// Triangles of random points, each with values of its own or its neighbours'.
TexturedSoup random_textured(std::uint64_t seed) {
  TexturedSoup result{random_soup(seed, true), {}};
  std::mt19937 random(seed);
  const std::size_t triangles = result.soup.triangles.size();
  std::uniform_real_distribution<float> unit(-1, 2);
  CornerAttribute texture;
  texture.storage = CornerAttribute::Storage::real32;
  for (std::size_t i = 0; i < 2 * triangles + 2; ++i) {
    texture.values.push_back(static_cast<double>(unit(random)));
  }
  for (std::size_t i = 0; i < 3 * triangles; ++i) {
    texture.of_corner.push_back(static_cast<std::uint32_t>(random() % texture.count()));
  }
  result.attributes.corners = {texture, normals_of(result.soup), colours_of(result.soup)};
  result.attributes.materials.names = {"red", "the blue one", "3"};
  for (std::size_t t = 0; t < triangles; ++t) {
    result.attributes.materials.of_triangle.push_back(static_cast<std::uint32_t>(random() % 3));
  }
  return result;
}

void expect_same(const Attributes& made, const Attributes& given) {
  ASSERT_EQ(made.corners.size(), given.corners.size());
  for (std::size_t i = 0; i < given.corners.size(); ++i) {
    EXPECT_EQ(made.corners[i].kind, given.corners[i].kind);
    EXPECT_EQ(value_bits(made.corners[i]), value_bits(given.corners[i])) << "attribute " << i;
  }
  EXPECT_EQ(names_of(made.materials), names_of(given.materials));
}

class AttributesOf : public ::testing::TestWithParam<SoupFormat> {};

TEST_P(AttributesOf, RandomSoupComeBackBitForBit) {
  for_each_seed(1, 50, [&](std::uint64_t seed) {
    const TexturedSoup given = random_textured(seed);
    const std::string bytes =
        format_soup(given.soup, GetParam(), {.attributes = &given.attributes});
    const ReadResult result = parse_with_attributes(bytes);
    EXPECT_TRUE(result.report.warnings.empty());
    ASSERT_EQ(corner_bits(result.soup), corner_bits(given.soup));
    expect_same(result.attributes, given.attributes);
  });
}

// What a file is made of again is the file.
TEST_P(AttributesOf, FileIsTheSameAgain) {
  for_each_seed(1, 10, [&](std::uint64_t seed) {
    const TexturedSoup given = random_textured(seed);
    const std::string bytes =
        format_soup(given.soup, GetParam(), {.attributes = &given.attributes});
    const ReadResult once = parse_with_attributes(bytes);
    const std::string again = format_soup(once.soup, GetParam(), {.attributes = &once.attributes});
    const ReadResult twice = parse_with_attributes(again);
    EXPECT_EQ(format_soup(twice.soup, GetParam(), {.attributes = &twice.attributes}), again);
  });
}

TEST_P(AttributesOf, AttributesAreNotReadUnlessAskedFor) {
  const TexturedSoup given = random_textured(1);
  const std::string bytes = format_soup(given.soup, GetParam(), {.attributes = &given.attributes});
  EXPECT_TRUE(read_soup(bytes, "mesh").attributes.empty());
}

INSTANTIATE_TEST_SUITE_P(Formats, AttributesOf,
                         ::testing::Values(SoupFormat::obj, SoupFormat::ply_binary,
                                           SoupFormat::ply_ascii));

// Of each triangle of a soup of two, its word; the header has a text.
std::string coloured_stl(const std::string& header, std::uint16_t first, std::uint16_t second) {
  std::string bytes = format_soup(random_soup(1, true), SoupFormat::stl_binary).substr(0, 184);
  bytes.replace(0, header.size(), header);
  bytes[80] = 2;
  bytes[81] = bytes[82] = bytes[83] = 0;
  std::memcpy(bytes.data() + 132, &first, 2);
  std::memcpy(bytes.data() + 182, &second, 2);
  return bytes;
}

// Names may come from formats that have no lines.
TEST(CarriedNames, DoNotBecomeLinesOfTheirOwn) {
  TriangleSoup soup;
  soup.points = {Vec3d(0, 0, 0), Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, 0, 1)};
  soup.triangles = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
  Attributes attributes;
  attributes.materials = {{"a\nv 9 9 9\nf 1 2 3", "a_v 9 9 9_f 1 2 3", "back\\", "tab\t\r"},
                          {0, 1, 2, 3}};
  attributes.groups = {{"g\nf 1 2 3", "end_header\n"}, {0, 0, 1, 1}};
  CornerAttribute other;
  other.kind = CornerAttribute::Kind::other;
  other.name = "x\nelement face 7";
  other.components = 1;
  other.values = {1, 2, 3};
  other.of_corner = {0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2};
  attributes.corners = {other};
  ReadOptions options;
  options.attributes = true;
  for (const SoupFormat format : {SoupFormat::obj, SoupFormat::ply_ascii, SoupFormat::ply_binary,
                                  SoupFormat::glb, SoupFormat::gltf, SoupFormat::threemf}) {
    SoupExtras extras;
    extras.attributes = &attributes;
    const ReadResult back =
        read_soup(std::string_view(format_soup(soup, format, extras)), "back", options);
    EXPECT_EQ(back.soup.triangles.size(), 4u) << format_name(format);
    EXPECT_EQ(back.soup.points.size(), 4u) << format_name(format);
    if (format == SoupFormat::threemf) continue;  // materials alone need looks there
    const TriangleLabels& materials = back.attributes.materials;
    std::vector<std::string> names;
    for (const std::uint32_t m : materials.of_triangle) names.push_back(materials.names[m]);
    std::sort(names.begin(), names.end());
    EXPECT_EQ(std::unique(names.begin(), names.end()) - names.begin(), 4) << format_name(format);
  }
}

TEST(StlColours, ColoursOfVisCamComeBack) {
  for (unsigned colour = 0; colour < 0x8000; colour += 7) {
    const std::string bytes =
        coloured_stl("x", static_cast<std::uint16_t>(0x8000u | colour), 0x1234);
    const ReadResult result = parse_with_attributes(bytes);
    ASSERT_EQ(result.attributes.corners.size(), 1u);
    const CornerAttribute& colours = result.attributes.corners[0];
    EXPECT_EQ(colours.count(), 1u);
    EXPECT_EQ(colours.of_corner[3], kNone);
    const std::string again =
        format_soup(result.soup, SoupFormat::stl_binary, {.attributes = &result.attributes});
    ASSERT_EQ(again.substr(132, 2), bytes.substr(132, 2));
    ASSERT_EQ(again.substr(182, 2), std::string(2, '\0'));
  }
  const CornerAttribute red =
      parse_with_attributes(coloured_stl("x", 0xFC00, 0)).attributes.corners.at(0);
  EXPECT_EQ(red.values, (std::vector<double>{1, 0, 0}));
}

TEST(StlColours, ColoursOfMagicsComeBackWithTheirHeader) {
  const std::string bytes = coloured_stl("COLOR=\x10\x20\x30\xFF,MATERIAL=abc", 0x001F, 0x8000);
  const ReadResult result = parse_with_attributes(bytes);
  EXPECT_EQ(result.attributes.corners.at(0).values, (std::vector<double>{1, 0, 0}));
  const std::string again =
      format_soup(result.soup, SoupFormat::stl_binary, {.attributes = &result.attributes});
  EXPECT_EQ(again.substr(0, 80), bytes.substr(0, 80));
  EXPECT_EQ(again.substr(132, 2), bytes.substr(132, 2));
  EXPECT_EQ(again.substr(182, 2), bytes.substr(182, 2));
}

TEST(StlColours, WordsWithoutTheirBitAreNone) {
  EXPECT_TRUE(parse_with_attributes(coloured_stl("x", 0x1234, 7)).attributes.corners.empty());
}

TEST(HeldBy, FormatsDropWhatTheyCannotHold) {
  const Attributes all = random_textured(1).attributes;
  EXPECT_EQ(held_by(SoupFormat::stl_binary, all).corners.size(), 1u);
  EXPECT_TRUE(held_by(SoupFormat::stl_binary, all).materials.empty());
  EXPECT_TRUE(held_by(SoupFormat::off, all).empty());
  EXPECT_EQ(held_by(SoupFormat::obj, all).corners.size(), 3u);
  EXPECT_EQ(held_by(SoupFormat::ply_ascii, all).materials.names.size(), 3u);
}

constexpr const char* kCubeAsObj = R"(mtllib lib/cube.mtl
o Thing
v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 1 0.5 0.25 1
vt 0 0
vt 1 0
vt 0.5 1
vn 0 0 -1
g bottom
usemtl wood
s 1
f 1/1/1 3/3/1 2/2/1
g sides
usemtl steel plate
s off
f 1/1 2/2 4/3
f 2 3 4
f -4//-1 -1//-1 -2//-1
)";

TEST(ObjAttributes, AreReadAsTheFileSays) {
  const ReadResult result = parse_with_attributes(kCubeAsObj);
  ASSERT_EQ(result.soup.triangles.size(), 4u);
  const Attributes& attributes = result.attributes;
  ASSERT_EQ(attributes.corners.size(), 3u);
  const CornerAttribute& texture = attributes.corners[0];
  EXPECT_EQ(texture.of_corner, (std::vector<std::uint32_t>{0, 2, 1, 0, 1, 2, kNone, kNone, kNone,
                                                           kNone, kNone, kNone}));
  EXPECT_EQ(texture.values, (std::vector<double>{0, 0, 1, 0, 0.5, 1}));
  const CornerAttribute& normals = attributes.corners[1];
  EXPECT_EQ(normals.of_corner[2], 0u);
  EXPECT_EQ(normals.of_corner[3], kNone);
  EXPECT_EQ(normals.of_corner[9], 0u);
  const CornerAttribute& colours = attributes.corners[2];
  EXPECT_EQ(colours.of_corner[0], kNone);
  EXPECT_EQ(colours.values[3 * colours.of_corner[5] + 1], 0.25);
  EXPECT_EQ(names_of(attributes.materials),
            (std::vector<std::string>{"wood", "steel plate", "steel plate", "steel plate"}));
  EXPECT_EQ(names_of(attributes.groups),
            (std::vector<std::string>{"bottom", "sides", "sides", "sides"}));
  EXPECT_EQ(names_of(attributes.objects),
            (std::vector<std::string>{"Thing", "Thing", "Thing", "Thing"}));
  EXPECT_EQ(names_of(attributes.smoothing), (std::vector<std::string>{"1", "off", "off", "off"}));
}

TEST(ObjAttributes, CornersOfPolygonsKeepTheirValues) {
  const ReadResult result = parse_with_attributes(
      "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 0.5 0\nv 0 2 0\nvt 1 0\nvt 2 0\nvt 3 0\nvt 4 0\nvt 5 0\n"
      "f 1/1 2/2 3/3 4/4 5/5\nf 1/1 2/2 x\nf 1/5 2/4 3/3\n");
  ASSERT_EQ(result.soup.triangles.size(), 4u);
  const CornerAttribute& texture = result.attributes.corners.at(0);
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_EQ(texture.values[2 * texture.of_corner[i]], 1 + result.soup.triangles[i / 3][i % 3]);
  }
  EXPECT_EQ(texture.values[2 * texture.of_corner[9]], 5);
}

TEST(ObjAttributes, IndicesOutsideLeaveCornersWithoutValues) {
  const ReadResult result = parse_with_attributes(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/2 2/-2 3/0\nf 1/99999999999999999999 2/1x 3/1\n");
  const CornerAttribute& texture = result.attributes.corners.at(0);
  EXPECT_EQ(texture.of_corner, (std::vector<std::uint32_t>{kNone, kNone, kNone, kNone, 0, 0}));
  ASSERT_EQ(result.report.warnings.size(), 1u);
  EXPECT_EQ(texts(result.report.warnings)[0],
            "4 corners name texture coordinates or normals that are not there: left without");
}

TEST(ObjAttributes, IndicesOfValuesThatNoLineHasAreCounted) {
  for (const std::string corner : {"1/0", "1/7", "1/-1", "1//0", "1//77", "1//-1"}) {
    const ReadResult result =
        parse_with_attributes("v 0 0 0\nv 1 0 0\nv 0 1 0\nf " + corner + " 2/ 3\n");
    EXPECT_EQ(result.soup.triangles.size(), 1u);
    EXPECT_TRUE(result.attributes.corners.empty());
    ASSERT_EQ(result.report.warnings.size(), 1u) << corner;
    EXPECT_EQ(texts(result.report.warnings)[0],
              "1 corner names texture coordinates or normals that are not there: left without");
  }
}

}  // namespace
}  // namespace meshrepair
