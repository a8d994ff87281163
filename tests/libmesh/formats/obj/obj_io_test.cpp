// SPDX-License-Identifier: MIT
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

const std::string kPoints = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

std::vector<Triangle> triangles_of(const std::string& text) {
  return read_text(text, "a.obj").soup.triangles;
}

const std::vector<Triangle> kFirst = {{0, 1, 2}};

TEST(ReadObj, CornersInAllSpellings) {
  for (const std::string face :
       {"f 1 2 3", "f 1/1 2/1 3/1", "f 1/1/1 2/1/1 3/1/1", "f 1//1 2//1 3//1", "f -4 -3 -2",
        "f\t1\t2\t3 ", "  f 1 2 3", "f 1 2 3 # comment", "f 1 \\\n 2 3", "f 1 2 3\\\n",
        "f 1 \\ \n2 3", "f +1 2 3", "f 1/ 2/ 3/", "fo 1 2 3", "f 1.0 2.0 3.0"}) {
    EXPECT_EQ(triangles_of(kPoints + face + "\n"), kFirst) << face;
    EXPECT_EQ(triangles_of(replaced(kPoints + face, "\n", "\r\n")), kFirst) << face;
  }
}

TEST(ReadObj, FacesMayComeBeforePoints) { EXPECT_EQ(triangles_of("f 1 2 3\n" + kPoints), kFirst); }

TEST(ReadObj, NegativeIndexCountsFromThePointsReadSoFar) {
  EXPECT_EQ(triangles_of("v 0 0 0\nv 1 0 0\nv 1 1 0\nf -3 -2 -1\nv 0 1 0\nf -3 -2 -1\n"),
            (std::vector<Triangle>{{0, 1, 2}, {1, 2, 3}}));
}

TEST(ReadObj, ColorsAndWeightsAreIgnored) {
  const ReadResult result =
      read_text("v 1 2 3 0.1 0.2 0.3\nv 4 5 6 2\nv 7 8 9\nf 1 2 3\n", "a.obj");
  EXPECT_EQ(result.soup.points, (std::vector<Vec3d>{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}));
  EXPECT_TRUE(result.report.warnings.empty());
}

TEST(ReadObj, OtherElementsAreSaidAndNoFileIsOpened) {
  const std::string text =
      "mtllib /etc/passwd\ncall no_such.obj\no a\ng b\ns off\nusemtl c\nvn 0 0 1\nvt 0 0\n" +
      kPoints + "l 1 2 3\np 1\ncstype bezier\nf 1 2 3\n";
  const ReadResult result = read_text(text, "a.obj");
  EXPECT_EQ(result.soup.triangles, kFirst);
  EXPECT_EQ(texts(result.report.warnings),
            std::vector<std::string>{"3 elements left out: lines, points, curves or surfaces"});
}

TEST(ReadObj, CoordinatesAreDoubles) {
  const ReadResult result =
      read_text("v 1.000000001 1e39 1e-46\nv 1.000000002 0 0\nv 1 1 0\nf 1 2 3\n", "a.obj");
  EXPECT_EQ(result.soup.points[0], Vec3d(1.000000001, 1e39, 1e-46));
}

TEST(ReadObj, IndicesOutOfRangeAreCounted) {
  const ReadResult result = read_text(
      kPoints +
          "f 1 2 3\nf 1 2 5\nf 0 1 2\nf -9 1 2\nf 1 2 99999999999999999999\nf 1 2 4294967296\n",
      "a.obj");
  EXPECT_EQ(result.soup.triangles, kFirst);
  EXPECT_EQ(result.report.bad_faces, 5u);
}

TEST(ReadObj, GarbageIsCounted) {
  const ReadResult result =
      read_text(kPoints + "f a b c\nf /1 /2 /3\nf 1 2\nf\nv x y z\nf 1/a/b 2 3\n", "a.obj");
  EXPECT_EQ(result.soup.triangles, kFirst);
  EXPECT_EQ(result.report.bad_faces, 4u);
  EXPECT_EQ(result.report.bad_points, 1u);
  ASSERT_EQ(result.soup.points.size(), 5u);
  EXPECT_TRUE(std::isnan(result.soup.points[4].x()));
  EXPECT_THAT(texts(result.report.warnings).at(0), HasSubstr("(first: line 5)"));
}

TEST(ReadObj, CommentIsNotContinued) {
  EXPECT_EQ(triangles_of("# C:\\models\\\n" + kPoints + "f 1 2 3\n"), kFirst);
}

TEST(ReadObj, RepeatedCornersOfAPolygonAreLeftOut) {
  EXPECT_EQ(triangles_of(kPoints + "f 1 2 3 1\n"), kFirst);
  EXPECT_EQ(triangles_of(kPoints + "f 1 2 2 3\n"), kFirst);
  // A triangle is kept as it is.
  EXPECT_EQ(triangles_of(kPoints + "f 1 1 2\n"), (std::vector<Triangle>{{0, 0, 1}}));
}

TEST(ReadObj, CountsMayComeFirst) {
  for (const char* counts : {"3 1\n", "3\n1\n", "3 1 0\n"}) {
    const ReadResult result = read_text(counts + kPoints + "f 1 2 3\n", "a");
    EXPECT_EQ(result.report.format, SoupFormat::obj) << counts;
    EXPECT_EQ(result.soup.triangles, kFirst) << counts;
  }
}

// Lines are read in pieces on several threads, up to one that is odd.
TEST(ReadObj, OddLinesAmongManyPlainOnesChangeNothing) {
  constexpr std::uint32_t kPointsOnly = 50'000;
  for (const bool odd : {false, true}) {
    std::string text;
    for (std::uint32_t p = 0; p < kPointsOnly; ++p) {
      text += (odd && p % 7919 == 0 ? " v " : "v ") + std::to_string(p) + " 0.5 -1e-3\n";
    }
    for (std::uint32_t p = 2; p < kPointsOnly; ++p) {
      text += "f " + std::to_string(p - 1) + ' ' + std::to_string(p) + "//7 ";
      text += odd && p % 7907 == 0 ? "-" + std::to_string(kPointsOnly - p) : std::to_string(p + 1);
      text += '\n';
    }
    const ReadResult result = read_text(text, "a.obj");
    ASSERT_EQ(result.soup.points.size(), kPointsOnly);
    ASSERT_EQ(result.soup.triangles.size(), kPointsOnly - 2);
    for (std::uint32_t p = 0; p < kPointsOnly; ++p) {
      ASSERT_EQ(result.soup.points[p], Vec3d(p, 0.5, -1e-3));
      if (p < 2) continue;
      ASSERT_EQ(result.soup.triangles[p - 2], (Triangle{p - 2, p - 1, p}));
    }
  }
}

TEST(ReadObj, PointsWithoutFacesAreRefused) {
  EXPECT_EQ(refusal_of(kPoints, "a.obj"), "a.obj: holds 4 points but no faces");
  EXPECT_THAT(refusal_of(kPoints + "f 7 8 9\n", "a.obj"),
              HasSubstr("holds no readable faces (1 face left out"));
}

TEST(WriteObj, CommentsComeFirst) {
  EXPECT_EQ(format_soup({{{0.1, 0, -0.0}}, {}}, SoupFormat::obj, {{"one", "two"}}),
            "# one\n# two\nv 0.1 0 -0\n");
}

}  // namespace
}  // namespace meshrepair
