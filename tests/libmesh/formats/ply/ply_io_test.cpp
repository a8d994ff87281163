// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <gmock/gmock.h>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include <base/error.h>
#include <mesh/soup_io.h>

#include "soup_fixtures.h"
#include "warning_texts.h"

namespace meshrepair {
namespace {

using ::testing::HasSubstr;

const std::string kAxes = "property float x\nproperty float y\nproperty float z\n";
const std::string kIndices = "property list uchar int vertex_indices\n";
const std::string kHeader = "ply\nformat ascii 1.0\nelement vertex 3\n" + kAxes +
                            "element face 2\n" + kIndices + "end_header\n";
const std::string kPoints = "0 0 0\n1 0 0\n0 1 0\n";
const std::string kFaces = "3 0 1 2\n3 2 1 0\n";
const std::vector<Triangle> kTriangles = {{0, 1, 2}, {2, 1, 0}};
const std::vector<Vec3d> kExpectedPoints = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

void expect_both_triangles(const std::string& bytes) {
  const ReadResult result = read_text(bytes, "a.ply");
  EXPECT_EQ(result.soup.points, kExpectedPoints) << bytes;
  EXPECT_EQ(result.soup.triangles, kTriangles) << bytes;
  EXPECT_TRUE(result.report.warnings.empty()) << bytes;
}

template <class Number>
std::string raw(Number value, bool big) {
  std::array<char, sizeof value> bytes = std::bit_cast<std::array<char, sizeof value>>(value);
  if (big) std::reverse(bytes.begin(), bytes.end());
  return {bytes.data(), bytes.size()};
}

// Point, Count and Index are the types in the file; `extra` puts properties around those that
// matter.
template <class Point, class Count, class Index>
std::string binary_ply(const std::string& types, bool big, bool extra) {
  const std::size_t first = types.find(' ');
  const std::size_t second = types.find(' ', first + 1);
  const std::string point_type = types.substr(0, first);
  const std::string count_type = types.substr(first + 1, second - first - 1);
  const std::string index_type = types.substr(second + 1);
  std::string bytes =
      std::string("ply\nformat binary_") + (big ? "big" : "little") + "_endian 1.0\n";
  bytes += "element vertex 3\n";
  if (extra) bytes += "property list uchar short tags\n";
  for (const char* axis : {"x", "y", "z"}) bytes += "property " + point_type + " " + axis + "\n";
  if (extra) bytes += "property uchar red\n";
  bytes += "element face 2\n";
  if (extra) bytes += "property ushort flag\n";
  bytes += "property list " + count_type + " " + index_type + " vertex_indices\n";
  if (extra) bytes += "property list uchar float texcoord\n";
  bytes += "end_header\n";
  for (const Vec3d& point : kExpectedPoints) {
    if (extra) bytes += '\2' + raw<std::int16_t>(7, big) + raw<std::int16_t>(8, big);
    for (const double value : point) bytes += raw(static_cast<Point>(value), big);
    if (extra) bytes += '\1';
  }
  for (const Triangle& triangle : kTriangles) {
    if (extra) bytes += raw<std::uint16_t>(9, big);
    bytes += raw(static_cast<Count>(3), big);
    for (const std::uint32_t corner : triangle) bytes += raw(static_cast<Index>(corner), big);
    if (extra) bytes += '\1' + raw(0.5f, big);
  }
  return bytes;
}

TEST(ReadPly, Ascii) { expect_both_triangles(kHeader + kPoints + kFaces); }

TEST(ReadPly, HeadersAsTheyOccur) {
  const std::string ascii = kHeader + kPoints + kFaces;
  expect_both_triangles(replaced(ascii, "\n", "\r\n"));
  expect_both_triangles(replaced(ascii, "\n", "\r"));
  expect_both_triangles(replaced(ascii, "vertex_indices", "vertex_index"));
  expect_both_triangles(replaced(ascii, "vertex_indices", "corners"));
  expect_both_triangles(replaced(ascii, "ply\n", "ply \ncomment element face 7\nobj_info x\n"));
  expect_both_triangles(replaced(ascii, "float", "float64"));
  expect_both_triangles("\xEF\xBB\xBF" + ascii);
}

TEST(ReadPly, BinaryOfAllTypes) {
  for (const bool big : {false, true}) {
    for (const bool extra : {false, true}) {
      expect_both_triangles(
          binary_ply<float, std::uint8_t, std::int32_t>("float uchar int", big, extra));
      expect_both_triangles(
          binary_ply<double, std::int32_t, std::uint32_t>("double int uint", big, extra));
      expect_both_triangles(
          binary_ply<float, std::uint16_t, std::uint16_t>("float ushort ushort", big, extra));
      expect_both_triangles(
          binary_ply<std::int8_t, std::int8_t, std::uint8_t>("char char uchar", big, extra));
      expect_both_triangles(
          binary_ply<std::int16_t, float, float>("int16 float float32", big, extra));
      expect_both_triangles(
          binary_ply<double, std::int64_t, std::uint64_t>("double int64 uint64", big, extra));
    }
  }
}

TEST(ReadPly, BoolIsOneByte) {
  const std::string header = "ply\nformat binary_little_endian 1.0\nelement vertex 3\n" + kAxes +
                             "property bool x_is_fixed\nelement face 2\nproperty bool is_seen\n" +
                             kIndices + "end_header\n";
  std::string bytes = header;
  for (const Vec3d& point : kExpectedPoints) {
    for (const double value : point) bytes += raw(static_cast<float>(value), false);
    bytes += '\1';
  }
  for (const Triangle& triangle : kTriangles) {
    bytes += '\0';
    bytes += '\3';
    for (const std::uint32_t corner : triangle) bytes += raw(corner, false);
  }
  expect_both_triangles(bytes);
}

TEST(ReadPly, LineEndOfABinaryHeaderIsThatOfItsFirstLine) {
  const std::string bytes =
      binary_ply<float, std::uint8_t, std::int32_t>("float uchar int", false, false);
  const std::size_t data = bytes.find("end_header\n") + 11;
  const std::string body = bytes.substr(data);
  expect_both_triangles(replaced(bytes.substr(0, data), "\n", "\r\n") + body);
  // A body that begins with a line feed is not taken for a part of the line end.
  const std::string header = replaced(bytes.substr(0, data), "float", "char");
  const std::string points = std::string("\n\0\0\n\1\0\0\1\1", 9);
  const std::string faces = body.substr(body.size() - 26);
  EXPECT_EQ(read_text(replaced(header, "\n", "\r") + points + faces, "a.ply").soup.points[0],
            Vec3d(10, 0, 0));
  EXPECT_EQ(read_text(header + points + faces, "a.ply").soup.points[0], Vec3d(10, 0, 0));
}

TEST(ReadPly, FacesMayComeBeforePoints) {
  expect_both_triangles("ply\nformat ascii 1.0\nelement face 2\n" + kIndices +
                        "element vertex 3\n" + kAxes + "end_header\n" + kFaces + kPoints);
}

TEST(ReadPly, OtherElementsArePassedOverAndSaid) {
  const ReadResult result = read_text(
      "ply\nformat ascii 1.0\nelement camera 1\nproperty float a\nproperty list int int b\n" +
          ("element vertex 3\n" + kAxes) +
          "element nothing 5\nelement material 2\nproperty int c\n" + "element face 2\n" +
          kIndices + "end_header\n0.5 2 7 8\n" + kPoints + "1\n2\n" + kFaces,
      "a.ply");
  EXPECT_EQ(result.soup.triangles, kTriangles);
  EXPECT_EQ(texts(result.report.warnings),
            std::vector<std::string>{"what is not known here is left out: camera, material"});
}

TEST(ReadPly, WhatALineHoldsBeyondItsItemIsIgnored) {
  expect_both_triangles(kHeader + "0 0 0 9\n1 0 0 9\n0 1 0 9\n" +
                        "3 0 1 2 255 0 0\n3 2 1 0 0 0 0\n");
}

TEST(ReadPly, ReadsAsciiOfOneLine) {
  expect_both_triangles(kHeader + replaced(kPoints + kFaces, "\n", " "));
}

TEST(ReadPly, StripsAreCutIntoTriangles) {
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 5\n" + kAxes +
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n" +
      "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n9 0 1 2 3 4 -1 2 1 0\n";
  EXPECT_EQ(read_text(text, "a.ply").soup.triangles,
            (std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {2, 1, 0}}));
}

TEST(ReadPly, CountsAreNotTrusted) {
  const ReadResult ascii =
      read_text(replaced(kHeader, "face 2", "face 4000000000") + kPoints + kFaces, "a.ply");
  EXPECT_EQ(ascii.soup.triangles, kTriangles);
  EXPECT_EQ(ascii.report.missing_faces, 3999999998u);
  EXPECT_EQ(texts(ascii.report.warnings).at(0),
            "the header promises 4000000000 of the element face, the file holds 2");

  const std::string bytes =
      binary_ply<float, std::uint8_t, std::int32_t>("float uchar int", false, false);
  const ReadResult binary = read_text(replaced(bytes, "face 2", "face 4000000000"), "a.ply");
  EXPECT_EQ(binary.soup.triangles, kTriangles);
  EXPECT_EQ(binary.report.missing_faces, 3999999998u);
  EXPECT_THAT(refusal_of(replaced(bytes, "vertex 3", "vertex 4000000000"), "a.ply"),
              HasSubstr("but no faces"));

  const ReadResult fewer = read_text(replaced(bytes, "face 2", "face 1"), "a.ply");
  EXPECT_EQ(fewer.soup.triangles.size(), 1u);
  EXPECT_EQ(fewer.report.trailing_bytes, 13u);
}

TEST(ReadPly, CutBinaryIsReadAsFarAsItGoes) {
  const std::string bytes =
      binary_ply<float, std::uint8_t, std::int32_t>("float uchar int", false, false);
  const ReadResult result = read_text(bytes.substr(0, bytes.size() - 5), "a.ply");
  EXPECT_EQ(result.soup.triangles.size(), 1u);
  EXPECT_EQ(result.report.missing_faces, 1u);
  EXPECT_EQ(result.report.trailing_bytes, 8u);
}

TEST(ReadPly, LengthsOfListsAreNotTrusted) {
  const ReadResult ascii = read_text(kHeader + kPoints + "3000000000 0 1 2\n3 2 1 0\n", "a.ply");
  EXPECT_EQ(ascii.soup.triangles, (std::vector<Triangle>{{2, 1, 0}}));
  EXPECT_EQ(ascii.report.bad_faces, 1u);

  std::string bytes = binary_ply<float, std::int32_t, std::int32_t>("float int int", false, false);
  for (const std::int32_t lie : {-1, 7, 2000000000}) {
    bytes.replace(bytes.size() - 16, 4, raw(lie, false));
    const ReadResult result = read_text(bytes, "a.ply");
    EXPECT_EQ(result.soup.triangles.size(), 1u);
    EXPECT_EQ(result.report.missing_faces, 1u);
  }
}

TEST(ReadPly, PointThatIsNoNumberIsKeptAsNan) {
  const ReadResult result = read_text(kHeader + "0 x 0\n1 0\n0 nan 0\n" + kFaces, "a.ply");
  EXPECT_EQ(result.soup.triangles, kTriangles);
  EXPECT_EQ(result.report.bad_points, 2u);
  EXPECT_EQ(result.soup.points.size(), 3u);
}

TEST(ReadPly, HeadersThatCannotBeUnderstoodAreRefusedWithTheLine) {
  EXPECT_EQ(refusal_of("ply\nformat ascii 1.0\nelement vertex 3\n", "a.ply"),
            "a.ply: the PLY header has no end_header");
  EXPECT_EQ(refusal_of(replaced(kHeader, "float", "quad"), "a.ply"),
            "a.ply:4: unknown PLY type 'quad'");
  EXPECT_THAT(refusal_of(replaced(kHeader, "vertex 3", "vertex many"), "a.ply"),
              HasSubstr("a.ply:3: "));
  EXPECT_THAT(refusal_of(replaced(kHeader, "vertex 3", "vertex -3"), "a.ply"),
              HasSubstr("a.ply:3: "));
  EXPECT_THAT(refusal_of(replaced(kHeader, "ascii", "binary_middle_endian"), "a.ply"),
              HasSubstr("a.ply:2: "));
  EXPECT_THAT(refusal_of("ply\nformat ascii 1.0\nproperty int x\n", "a.ply"),
              HasSubstr("before the first element"));
  EXPECT_THAT(refusal_of("ply\nelement vertex 3\nend_header\n", "a.ply"),
              HasSubstr("which format"));
  EXPECT_THAT(refusal_of(replaced(kHeader, " x", " u"), "a.ply"), HasSubstr("no x, y and z"));
  EXPECT_THAT(refusal_of(replaced(kHeader, "list uchar int", "int"), "a.ply"),
              HasSubstr("no vertex_indices"));
}

TEST(WritePly, SourcesAreAPropertyThatReadersPassOver) {
  TriangleSoup soup;
  soup.points = kExpectedPoints;
  soup.triangles = kTriangles;
  const std::vector<std::uint32_t> sources = {7, ~std::uint32_t{0}};
  const std::string ascii = format_soup(soup, SoupFormat::ply_ascii, {{}, sources});
  expect_both_triangles(ascii);
  EXPECT_THAT(ascii, HasSubstr("vertex_indices\nproperty int source_triangle\nend_header\n"));
  EXPECT_TRUE(ascii.ends_with("\n3 0 1 2 7\n3 2 1 0 -1\n"));
  const std::string binary = format_soup(soup, SoupFormat::ply_binary, {{}, sources});
  expect_both_triangles(binary);
  EXPECT_TRUE(binary.ends_with(raw(std::int32_t{-1}, false)));
  EXPECT_EQ(binary.substr(binary.size() - 21, 4), raw(std::int32_t{7}, false));
}

// Numbers of points, from `first` on, under this name.
CornerAttribute numbered_points(const TriangleSoup& soup, const std::string& name, double first) {
  CornerAttribute numbers;
  numbers.name = name;
  numbers.kind = CornerAttribute::Kind::other;
  numbers.place = CornerAttribute::Place::point;
  numbers.storage = CornerAttribute::Storage::integer;
  numbers.components = 1;
  for (std::size_t p = 0; p < soup.points.size(); ++p) {
    numbers.values.push_back(first + static_cast<double>(p));
  }
  for (const auto& triangle : soup.triangles) {
    numbers.of_corner.insert(numbers.of_corner.end(), triangle.begin(), triangle.end());
  }
  return numbers;
}

Attributes read_back(const TriangleSoup& soup, const Attributes& attributes, SoupFormat format) {
  ReadOptions options;
  options.attributes = true;
  ReadResult back =
      read_soup(format_soup(soup, format, {.attributes = &attributes}), "a.ply", options);
  EXPECT_EQ(back.soup.points, soup.points);
  return std::move(back.attributes);
}

TEST(WritePly, IntegersBeyondIntStayWhatTheyAre) {
  const TriangleSoup soup = tetrahedron();
  Attributes attributes;
  for (const double first : {7.0, 4e9, -9e15}) {
    attributes.corners = {numbered_points(soup, "id", first)};
    for (const SoupFormat format : {SoupFormat::ply_ascii, SoupFormat::ply_binary}) {
      const Attributes back = read_back(soup, attributes, format);
      ASSERT_EQ(back.corners.size(), 1U);
      EXPECT_TRUE(std::is_permutation(back.corners[0].values.begin(), back.corners[0].values.end(),
                                      attributes.corners[0].values.begin(),
                                      attributes.corners[0].values.end()));
    }
  }
}

TEST(WritePly, NoNameIsThereTwice) {
  const TriangleSoup soup = tetrahedron();
  Attributes attributes;
  for (const char* name : {"x", "a b", "a_b", "source_triangle"}) {
    attributes.corners.push_back(numbered_points(soup, name, 1));
  }
  std::vector<std::string> names;
  for (const CornerAttribute& one : read_back(soup, attributes, SoupFormat::ply_binary).corners) {
    names.push_back(one.name);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"x_", "a_b", "a_b_", "source_triangle_"}));
}

TEST(WritePly, SourcesNeedPly) {
  const TriangleSoup soup = tetrahedron();
  const std::vector<std::uint32_t> sources = {0, 1, 2, 3};
  for (const SoupFormat format :
       {SoupFormat::stl_binary, SoupFormat::stl_ascii, SoupFormat::obj, SoupFormat::off}) {
    EXPECT_THROW(static_cast<void>(format_soup(soup, format, {{}, sources})), UsageError);
  }
}

TEST(ReadPly, PointsWithoutFacesAreRefused) {
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 3\n" + kAxes + "end_header\n" + kPoints;
  EXPECT_EQ(refusal_of(text, "a.ply"), "a.ply: holds 3 points but no faces");
}

// Each has properties of its own, so their values make no list.
TEST(ReadPly, SeveralElementsOfOneNameCarryNothing) {
  const std::string text =
      "ply\nformat ascii 1.0\n"
      "element vertex 3\n" +
      kAxes +
      "property uchar red\nproperty uchar green\nproperty uchar blue\n"
      "element vertex 1\nproperty float u\n" +
      kAxes +
      "property float a\nproperty float b\nproperty float c\nproperty float d\n"
      "element face 1\nproperty list uchar int vertex_indices\n"
      "element face 1\nproperty int material_index\nproperty list uchar int vertex_indices\n"
      "property list uchar float texcoord\nend_header\n"
      "0 0 0 1 2 3\n1 0 0 1 2 3\n0 1 0 1 2 3\n0.5 0 0 1 7 7 7 7\n3 0 1 2\n4 3 0 3 1 2 1 2\n";
  ReadOptions options;
  options.attributes = true;
  const ReadResult result = read_soup(std::string_view(text), "a.ply", options);
  EXPECT_EQ(result.soup.triangles.size(), 2u);
  EXPECT_TRUE(result.attributes.is_bare());
}

}  // namespace
}  // namespace meshrepair
