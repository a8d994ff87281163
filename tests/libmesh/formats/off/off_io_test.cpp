// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <gmock/gmock.h>
#include <string>

#include <gtest/gtest.h>

#include <mesh/soup_io.h>

#include "soup_fixtures.h"
#include "warning_texts.h"

namespace meshrepair {
namespace {

using ::testing::HasSubstr;

const std::string kCounts = "3 2 0\n";
const std::string kPoints = "0 0 0\n1 0 0\n0 1 0\n";
const std::string kFaces = "3 0 1 2\n3 2 1 0\n";
const std::vector<Triangle> kTriangles = {{0, 1, 2}, {2, 1, 0}};
const std::vector<Vec3d> kExpectedPoints = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

// A value as a big-endian file has it.
template <class Number>
std::string big_endian(Number value) {
  auto bytes = std::bit_cast<std::array<char, sizeof value>>(value);
  if (std::endian::native == std::endian::little) std::reverse(bytes.begin(), bytes.end());
  return {bytes.data(), bytes.size()};
}

std::string words(std::initializer_list<std::int32_t> values) {
  std::string bytes;
  for (const std::int32_t value : values) bytes += big_endian(value);
  return bytes;
}

void expect_both_triangles(const std::string& text) {
  const ReadResult result = read_text(text, "a.off");
  EXPECT_EQ(result.soup.points, kExpectedPoints) << text;
  EXPECT_EQ(result.soup.triangles, kTriangles) << text;
  EXPECT_TRUE(result.report.warnings.empty()) << text;
}

TEST(ReadOff, HeadersAsTheyOccur) {
  for (const std::string header :
       {"OFF\n3 2 0\n", "OFF 3 2 0\n", "OFF3 2 0\n", "off\n3 2 0\n", "3 2 0\n",
        "# x\nOFF\n# y\n3 2 0\n\n# z\n", "OFF\n3 2\n", "OFF\n3\n2\n0\n", "COFF\n3 2 0\n",
        "NOFF\n3 2 0\n", "STCN4OFF\n3 2 0\n", "4OFF\n3 2 0\n", "nOFF\n3\n3 2 0\n", "noff\n3 2 0\n",
        "OFF\n3 2 0 # counts\n"}) {
    std::string text = header;
    text += kPoints;
    text += kFaces;
    expect_both_triangles(text);
    expect_both_triangles(replaced(text, "\n", "\r\n"));
  }
}

TEST(ReadOff, ReadsFilesOfOneLine) {
  expect_both_triangles(replaced("OFF\n" + kCounts + kPoints + kFaces, "\n", " "));
  expect_both_triangles(
      replaced(replaced("OFF\n" + kCounts + kPoints + kFaces, "\n", " "), " ", "\n"));
  expect_both_triangles("NOFF 3 2 0 0 0 0 9 9 9 1 0 0 9 9 9 0 1 0 9 9 9 " +
                        replaced(kFaces, "\n", " "));
}

TEST(ReadOff, WhatFollowsCoordinatesAndIndicesIsIgnored) {
  expect_both_triangles("OFF\n" + kCounts + kPoints + "3 0 1 2 255 0 0\n3 2 1 0 1 0.5 0.5 1\n");
  expect_both_triangles("OFF\n" + kCounts + "0 0 0 1 2 3\n1 0 0 1 2 3 \n0 1 0 1 2 3\n" + kFaces);
  expect_both_triangles("COFF\n" + kCounts +
                        "0 0 0 255 0 0 255\n1 0 0 255 0 0 255\n0 1 0 0 0 0 0\n" + kFaces);
}

TEST(ReadOff, HomogeneousCoordinatesAreDivided) {
  expect_both_triangles("4OFF\n" + kCounts + "0 0 0 1\n2 0 0 2\n0 0.5 0 0.5\n" + kFaces);
}

TEST(ReadOff, RefusesOtherDimensions) {
  EXPECT_THAT(refusal_of("nOFF\n5\n3 2 0\n" + kPoints + kFaces, "a.off"),
              HasSubstr("three coordinates"));
}

TEST(ReadOff, CountsAreNotTrusted) {
  const ReadResult more = read_text("OFF\n3 9999999 0\n" + kPoints + kFaces, "a.off");
  EXPECT_EQ(more.soup.triangles, kTriangles);
  EXPECT_EQ(more.report.missing_faces, 9999997u);
  EXPECT_EQ(more.report.warnings.size(), 1u);

  const ReadResult fewer = read_text("OFF\n3 1 0\n" + kPoints + kFaces, "a.off");
  EXPECT_EQ(fewer.soup.triangles, kTriangles);
  EXPECT_EQ(fewer.report.warnings.size(), 1u);

  EXPECT_THAT(refusal_of("OFF\n4000000000 4000000000 0\n" + kPoints + kFaces, "a.off"),
              HasSubstr("holds 5 points but no faces (the header promises 4000000000 points"));
  EXPECT_THAT(refusal_of("OFF\n99999999999999999999 2 0\n" + kPoints + kFaces, "a.off"),
              HasSubstr("a.off:2: "));
  EXPECT_THAT(refusal_of("OFF\n-3 2 0\n" + kPoints + kFaces, "a.off"),
              HasSubstr("number of points"));
}

TEST(ReadOff, TextAfterTheLastFaceIsCounted) {
  const ReadResult result = read_text("OFF\n" + kCounts + kPoints + kFaces + "the end\n", "a.off");
  EXPECT_EQ(result.soup.triangles, kTriangles);
  EXPECT_EQ(result.report.trailing_bytes, 8u);
}

TEST(ReadOff, FaceThatClaimsMoreCornersThanItsLineHasIsLeftOut) {
  const ReadResult result =
      read_text("OFF\n" + kCounts + kPoints + "2000000000 0 1 2\n3 2 1 0\n", "a.off");
  EXPECT_EQ(result.soup.triangles, (std::vector<Triangle>{{2, 1, 0}}));
  EXPECT_EQ(result.report.bad_faces, 1u);
  EXPECT_THAT(texts(result.report.warnings).at(0), HasSubstr("line 6"));
}

TEST(ReadOff, IndexOutOfRangeIsCounted) {
  const ReadResult result = read_text("OFF\n" + kCounts + kPoints + "3 0 1 3\n3 2 1 0\n", "a.off");
  EXPECT_EQ(result.soup.triangles.size(), 1u);
  EXPECT_EQ(result.report.bad_faces, 1u);
}

TEST(ReadOff, LastFaceOfACutFileIsLeftOut) {
  const ReadResult result = read_text("OFF\n3 9 0\n" + kPoints + "3 0 1 2\n3 0 1 2", "a.off");
  EXPECT_EQ(result.soup.triangles.size(), 1u);
  EXPECT_EQ(result.report.missing_faces, 8u);
}

TEST(ReadOff, LettersForCoordinatesAreKeptAsNan) {
  const ReadResult result =
      read_text("OFF\n" + kCounts + "0 0 0\n1 x 0\n0 nan 0\n" + kFaces, "a.off");
  EXPECT_EQ(result.soup.triangles.size(), 2u);
  EXPECT_EQ(result.report.bad_points, 1u);
  EXPECT_TRUE(std::isnan(result.soup.points[1].y()));
}

std::string binary_off() {
  std::string bytes = "OFF BINARY\n" + words({3, 2, 0});
  for (const Vec3d& point : kExpectedPoints) {
    for (const double value : point) bytes += big_endian(static_cast<float>(value));
  }
  return bytes + words({3, 0, 1, 2, 0}) + words({3, 2, 1, 0, 1, 0});
}

TEST(ReadOff, Binary) {
  const ReadResult result = read_text(binary_off(), "a.off");
  EXPECT_EQ(result.soup.points, kExpectedPoints);
  EXPECT_EQ(result.soup.triangles, kTriangles);
  EXPECT_TRUE(result.report.warnings.empty());
}

TEST(ReadOff, BinaryCountsAreNotTrusted) {
  std::string bytes = binary_off();
  bytes.replace(11 + 4, 4, words({2000000000}));
  const ReadResult result = read_text(bytes, "a.off");
  EXPECT_EQ(result.soup.triangles, kTriangles);
  EXPECT_EQ(result.report.missing_faces, 1999999998u);

  bytes = binary_off();
  bytes.replace(11 + 12 + 36, 4, words({-1}));
  EXPECT_THAT(refusal_of(bytes, "a.off"), HasSubstr("holds 3 points but no faces"));
}

}  // namespace
}  // namespace meshrepair
