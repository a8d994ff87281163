// SPDX-License-Identifier: MIT
#include <string>

#include <gtest/gtest.h>

#include <base/error.h>
#include <mesh/point_io.h>

#include "warning_texts.h"

namespace meshrepair {
namespace {

const PointReadOptions kAll = {.colours = true};

PointReadResult read(const std::string& text, const std::string& name = "cloud.xyz") {
  return read_points(std::string_view(text), name, kAll);
}

std::string failure_of(const std::string& text, const std::string& name = "cloud.xyz") {
  try {
    (void)read(text, name);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no failure";
}

const std::vector<Vec3d> kTwo = {{1, 2, 3}, {-4.5, 5e-3, 6}};

TEST(XyzPoints, AreThreeNumbersOnALine) {
  for (const char* text :
       {"1 2 3\n-4.5 5e-3 6\n", "1\t2\t3\r\n-4.5\t5e-3\t6",
        "# a comment\n\n1 2 3\n// another\n-4.5 5e-3 6\n", "1,2,3\n-4.5,5e-3,6\n",
        "1; 2; 3\n-4.5; 5e-3; 6\n", "x,y,z\n1,2,3\n-4.5,5e-3,6\n"}) {
    const PointReadResult result = read(text, "cloud.txt");
    EXPECT_EQ(result.cloud.points, kTwo) << text;
    EXPECT_TRUE(result.cloud.normals.empty());
  }
}

TEST(XyzPoints, ThreeMoreOfLengthOneAreNormals) {
  const PointReadResult result = read("1 2 3 0 0 1\n-4.5 5e-3 6 0.6 0 -0.8\n");
  EXPECT_EQ(result.cloud.points, kTwo);
  EXPECT_EQ(result.cloud.normals, (std::vector<Vec3d>{{0, 0, 1}, {0.6, 0, -0.8}}));
  EXPECT_TRUE(result.report.normals);
  const PointReadResult without =
      read_points(std::string_view("1 2 3 0 0 -1\n"), "a.xyz", {.normals = false});
  EXPECT_TRUE(without.cloud.normals.empty());
  EXPECT_TRUE(without.report.normals);
}

TEST(XyzPoints, NormalsThatAreAllZeroAreNone) {
  EXPECT_FALSE(read("1 2 3 0 0 0\n4 5 6 0 0 0\n").report.normals);
}

TEST(XyzPoints, ThreeMoreIntegersAreColours) {
  const PointReadResult result = read("1 2 3 255 0 128\n4 5 6 0 7 9\n");
  using Colours = std::vector<std::array<std::uint8_t, 3>>;
  EXPECT_EQ(result.cloud.colours, (Colours{{255, 0, 128}, {0, 7, 9}}));
  const PointReadResult with_both = read("1 2 3 9 8 7 0 -1 0\n4 5 6 6 5 4 1 0 0\n");
  EXPECT_EQ(with_both.cloud.colours, (Colours{{9, 8, 7}, {6, 5, 4}}));
  EXPECT_EQ(with_both.cloud.normals, (std::vector<Vec3d>{{0, -1, 0}, {1, 0, 0}}));
}

TEST(XyzPoints, PtsBeginsWithACountAndHasIntensities) {
  const PointReadResult result = read("2\n1 2 3 -1200 255 0 1\n-4.5 5e-3 6 7 1 2 3\n", "a.pts");
  EXPECT_EQ(result.report.format, PointFormat::pts);
  EXPECT_EQ(result.report.declared_points, 2U);
  EXPECT_EQ(result.cloud.points, kTwo);
  EXPECT_EQ(result.cloud.colours[1][2], 3);
}

TEST(XyzPoints, PwnMayHaveAllPointsBeforeAllNormals) {
  const PointReadResult result = read("2\n1 2 3\n-4.5 5e-3 6\n0 0 1\n0 1 0\n", "a.pwn");
  EXPECT_EQ(result.cloud.points, kTwo);
  EXPECT_EQ(result.cloud.normals, (std::vector<Vec3d>{{0, 0, 1}, {0, 1, 0}}));
}

std::string lines_of(std::size_t count, const std::string& line) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += line + "\n";
  return text;
}

TEST(XyzPoints, NormalsOfPwnAreNoPointsWhereTheCountIsWrong) {
  for (const char* count : {"98", "100", "101"}) {
    const PointReadResult result = read(
        count + lines_of(1, "") + lines_of(100, "1 2 3") + lines_of(100, "0 0.6 0.8"), "a.pwn");
    EXPECT_EQ(result.cloud.points, std::vector<Vec3d>(100, Vec3d(1, 2, 3))) << count;
    EXPECT_EQ(result.cloud.normals, std::vector<Vec3d>(100, Vec3d(0, 0.6, 0.8))) << count;
    EXPECT_EQ(result.report.warnings.empty(), count == std::string("100"));
  }
}

TEST(XyzPoints, NormalsOfPwnThatAreNotAllThereAreLeftOut) {
  const PointReadResult result =
      read("100\n" + lines_of(100, "1 2 3") + lines_of(60, "0 0.6 0.8"), "a.pwn");
  EXPECT_EQ(result.cloud.points, std::vector<Vec3d>(100, Vec3d(1, 2, 3)));
  EXPECT_TRUE(result.cloud.normals.empty());
  ASSERT_EQ(result.report.warnings.size(), 1u);
  EXPECT_EQ(texts(result.report.warnings)[0],
            "of 100 points the normals of 60 are there: none are taken");
}

TEST(XyzPoints, PureColoursAreNoNormals) {
  const PointReadResult result = read("1 2 3 1 0 0\n-4.5 5e-3 6 0 1 0\n");
  EXPECT_EQ(result.cloud.points, kTwo);
  EXPECT_TRUE(result.cloud.normals.empty());
}

TEST(XyzPoints, NamesOfColumnsSayWhereTheCoordinatesAre) {
  for (const char* text :
       {"index,x,y,z\n7,1,2,3\n8,-4.5,5e-3,6\n", "\"Z\";\"Y\";\"X\"\n3;2;1\n6;5e-3;-4.5\n",
        "//Z Y X R\n2\n3 2 1 9\n6 5e-3 -4.5 9\n", "//X Y Z R\n2\n1 2 3 9\n-4.5 5e-3 6 9\n",
        "# x y z\n1 2 3\n-4.5 5e-3 6\n"}) {
    const PointReadResult result = read(text, "cloud.csv");
    EXPECT_EQ(result.cloud.points, kTwo) << text;
    EXPECT_TRUE(result.report.warnings.empty()) << text;
  }
}

TEST(XyzPoints, WordsOfACommentAreNoNames) {
  for (const char* text : {"# points as x y z\n1 2 3\n-4.5 5e-3 6\n",
                           "# z y x and more\n# 1 2 3 4 5\n1 2 3\n-4.5 5e-3 6\n"}) {
    EXPECT_EQ(read(text).cloud.points, kTwo) << text;
  }
}

TEST(XyzPoints, CommasAreDecimalOnesBetweenSemicolons) {
  EXPECT_EQ(read("1;2;3\n-4,5;0,005;6\n", "cloud.csv").cloud.points, kTwo);
  EXPECT_EQ(read("1,0;2,0;3,0\n-4,5;5e-3;6,0\n", "cloud.csv").cloud.points, kTwo);
}

TEST(XyzPoints, ACountThatIsTooLargeIsSaidAndCostsNothing) {
  const PointReadResult result = read("999999999999\n1 2 3\n-4.5 5e-3 6\n", "a.pts");
  EXPECT_EQ(result.cloud.points, kTwo);
  EXPECT_EQ(result.report.missing_points, 999999999997U);
  EXPECT_EQ(result.report.warnings.size(), 1U);
}

TEST(XyzPoints, BadLinesAreLeftOutAndCounted) {
  const PointReadResult result = read("1 2 3\nabc\n1 2\n-4.5 5e-3 6\n7 x 8\n1 1 1\n2 2 2\n");
  EXPECT_EQ(result.cloud.points.size(), 4U);
  EXPECT_EQ(result.report.bad_points, 3U);
  EXPECT_EQ(texts(result.report.warnings)[0],
            "3 lines without three numbers left out (first: line 2)");
}

TEST(XyzPoints, NaNIsKept) {
  const PointReadResult result = read("1 2 3\nnan nan nan\n1 inf 2\n");
  EXPECT_EQ(result.cloud.points.size(), 3U);
  EXPECT_FALSE(result.cloud.points[1].allFinite());
}

TEST(XyzPoints, TextThatIsSomethingElseIsRefusedWithItsLine) {
  EXPECT_EQ(failure_of("1 2 3\nonce\nupon\na time\n"),
            "cloud.xyz:2: is no list of points: 3 lines without three numbers, 1 with");
  EXPECT_EQ(failure_of("once upon a time\n"),
            "cloud.xyz: is no list of points: it does not begin with lines of three numbers");
  EXPECT_EQ(failure_of(""), "cloud.xyz: is empty");
  EXPECT_NE(failure_of(std::string("\x01\x00\x02junk", 7)), "no failure");
}

}  // namespace
}  // namespace meshrepair
