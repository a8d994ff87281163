// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstring>
#include <gmock/gmock.h>
#include <string>

#include <gtest/gtest.h>

#include <mesh/soup_io.h>

#include "soup_fixtures.h"
#include "warning_texts.h"

namespace meshrepair {
namespace {

using ::testing::HasSubstr;

std::string binary_tetrahedron() { return format_soup(tetrahedron(), SoupFormat::stl_binary); }
std::string ascii_tetrahedron() { return format_soup(tetrahedron(), SoupFormat::stl_ascii); }

std::string with_count(std::string bytes, std::uint32_t count) {
  std::memcpy(bytes.data() + 80, &count, sizeof count);
  return bytes;
}

void expect_tetrahedron(const ReadResult& result) {
  EXPECT_EQ(result.soup.points.size(), 4u);
  EXPECT_EQ(corner_bits(result.soup), corner_bits(tetrahedron()));
}

TEST(ReadStl, BinaryIsWelded) {
  const ReadResult result = read_text(binary_tetrahedron(), "a.stl");
  EXPECT_EQ(result.report.format, SoupFormat::stl_binary);
  EXPECT_EQ(result.report.declared_triangles, 4u);
  EXPECT_TRUE(result.report.warnings.empty());
  expect_tetrahedron(result);
}

TEST(ReadStl, CountInHeaderIsNotTrusted) {
  for (const std::uint32_t count : {0u, 3u, 5u, 0xFFFFFFFFu}) {
    const ReadResult result = read_text(with_count(binary_tetrahedron(), count), "a.stl");
    expect_tetrahedron(result);
    EXPECT_EQ(result.report.declared_triangles, count);
    EXPECT_EQ(result.report.missing_faces, count > 4 ? count - 4 : 0);
    ASSERT_EQ(result.report.warnings.size(), 1u);
    EXPECT_THAT(texts(result.report.warnings)[0], HasSubstr("the file holds 4"));
  }
}

TEST(ReadStl, CutBinarySaysHowManyTrianglesAreMissing) {
  const std::string cut = binary_tetrahedron().substr(0, 84 + 50 * 2 + 17);
  const ReadResult result = read_text(cut, "a.stl");
  EXPECT_EQ(result.soup.triangles.size(), 2u);
  EXPECT_EQ(result.report.missing_faces, 2u);
  EXPECT_EQ(result.report.trailing_bytes, 17u);
  EXPECT_EQ(texts(result.report.warnings).at(0),
            "the header promises 4 triangles, the file holds 2");
}

TEST(ReadStl, TrailingBytesAreCounted) {
  const ReadResult result = read_text(binary_tetrahedron() + "trailer", "a.stl");
  expect_tetrahedron(result);
  EXPECT_EQ(result.report.trailing_bytes, 7u);
}

TEST(ReadStl, BinaryHeaderMayBeginWithSolid) {
  std::string bytes = binary_tetrahedron();
  bytes.replace(0, 40, "solid facet normal outer loop vertex 1 2");
  EXPECT_EQ(read_text(bytes, "a.stl").report.format, SoupFormat::stl_binary);
  expect_tetrahedron(read_text(bytes, "a.stl"));
  expect_tetrahedron(read_text(bytes + "\r\n", "a.stl"));
}

TEST(ReadStl, BinaryIsKnownWithoutExtensionWhenTheCountFits) {
  expect_tetrahedron(read_text(binary_tetrahedron(), "-"));
  EXPECT_THAT(refusal_of(binary_tetrahedron() + "x", "mesh"), HasSubstr("no known format"));
}

TEST(ReadStl, HeaderAloneIsRefused) {
  EXPECT_EQ(refusal_of(binary_tetrahedron().substr(0, 84), "a.stl"),
            "a.stl: holds no triangles (the header promises 4 triangles, the file holds 0)");
  EXPECT_THAT(refusal_of(binary_tetrahedron().substr(0, 83), "a.stl"), HasSubstr("cut within"));
}

TEST(ReadStl, NotFiniteFloatsAreKept) {
  TriangleSoup soup = tetrahedron();
  soup.points[1].x() = std::nan("");
  soup.points[2].y() = INFINITY;
  const ReadResult result = read_text(format_soup(soup, SoupFormat::stl_binary), "a.stl");
  EXPECT_EQ(result.soup.points.size(), 4u);
  EXPECT_EQ(result.soup.triangles.size(), 4u);
  EXPECT_EQ(result.report.bad_points, 0u);
}

TEST(ReadStl, MinusZeroIsZero) {
  const TriangleSoup soup = {{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}}, {{{0, 1, 2}}, {{2, 1, 0}}}};
  std::string bytes = format_soup(soup, SoupFormat::stl_binary);
  const float minus_zero = -0.0f;
  std::memcpy(bytes.data() + 84 + 24, &minus_zero, sizeof minus_zero);  // x of the second corner
  std::memcpy(bytes.data() + 84 + 50 + 32, &minus_zero, sizeof minus_zero);  // z of that
  EXPECT_EQ(read_text(bytes, "a.stl").soup.points.size(), 3u);
}

TEST(WriteStl, MinusZeroIsWrittenAsItWillBeRead) {
  const TriangleSoup with = {{{-0.0, 0, -1e-50}, {0, 1, -0.0}, {1, -0.0, 0}}, {{{0, 1, 2}}}};
  const TriangleSoup without = {{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}}, {{{0, 1, 2}}}};
  EXPECT_EQ(format_soup(with, SoupFormat::stl_binary),
            format_soup(without, SoupFormat::stl_binary));
  TriangleSoup read = with;
  read.points[0].z() = 0;
  EXPECT_EQ(format_soup(read, SoupFormat::stl_ascii), format_soup(without, SoupFormat::stl_ascii));
}

TEST(ReadStl, AsciiInAnyLayout) {
  const std::string ascii = ascii_tetrahedron();
  std::string upper = ascii;
  for (char& c : upper) c = static_cast<char>(std::toupper(c));
  std::string title = replaced(replaced(ascii, "vertex", "Vertex"), "outer loop", "Outer Loop");
  const std::string body = ascii.substr(ascii.find('\n') + 1);
  const std::vector<std::string> layouts = {
      ascii,
      upper,
      title,
      replaced(ascii, "\n", "\r\n"),
      replaced(ascii, "\n", "\r"),
      replaced(ascii, "\n", "\n\n \n"),
      replaced(ascii, " ", "\t \t"),
      "solid x\n" + replaced(body, "\n", " "),
      replaced(ascii, "\n", " "),
      body,
      body.substr(0, body.find("endsolid")),
      "\xEF\xBB\xBF" + ascii,
      "\n\n" + ascii,
      "# made by x\n" + ascii,
      replaced(ascii, "solid meshrepair", "solid outer loop vertex 1 2 3"),
      replaced(ascii, "solid meshrepair", "solid"),
      replaced(ascii, "solid meshrepair", "solid na\xC3\xAFve"),
  };
  for (const std::string& layout : layouts) {
    const ReadResult result = read_text(layout, "a.stl");
    EXPECT_EQ(result.report.format, SoupFormat::stl_ascii) << layout;
    EXPECT_TRUE(result.report.warnings.empty()) << layout;
    expect_tetrahedron(result);
  }
}

TEST(ReadStl, SolidsAreJoined) {
  const ReadResult result = read_text(ascii_tetrahedron() + ascii_tetrahedron(), "a.stl");
  EXPECT_EQ(result.soup.points.size(), 4u);
  EXPECT_EQ(result.soup.triangles.size(), 8u);
  // All on one line as well.
  const std::string line = replaced(ascii_tetrahedron(), "\n", " ");
  EXPECT_EQ(read_text(line + line, "a.stl").soup.triangles.size(), 8u);
}

TEST(ReadStl, TextWithZeroBytesIsText) {
  const std::string zeros(80, '\0');
  const std::string text = ascii_tetrahedron();
  std::string padded = text;
  padded.insert(padded.find('\n'), zeros);
  for (const std::string& bytes : {padded, text + zeros, replaced(text, "\n", "\n" + zeros)}) {
    const ReadResult result = read_text(bytes, "a.stl");
    EXPECT_EQ(result.report.format, SoupFormat::stl_ascii);
    expect_tetrahedron(result);
  }
  const std::string binary = "solid" + binary_tetrahedron().substr(5) + "rest";
  EXPECT_EQ(read_text(binary, "a.stl").report.format, SoupFormat::stl_binary);
}

TEST(ReadStl, OddNumbersAreNumbers) {
  const std::string text =
      "facet normal 0 0 0 outer loop vertex 1,5 +2 -3,25e-1 vertex 1.0D+02 nan -1.#IND "
      "vertex 1.#INF -1.#INF 1e-999 endloop endfacet";
  const ReadResult result = read_text(text, "a.stl");
  ASSERT_EQ(result.soup.points.size(), 3u);
  EXPECT_EQ(result.soup.points[0], Vec3d(1.5, 2, -0.325));
  EXPECT_EQ(result.soup.points[1].x(), 100);
  EXPECT_TRUE(std::isnan(result.soup.points[1].y()));
  EXPECT_TRUE(std::isnan(result.soup.points[1].z()));
  EXPECT_EQ(result.soup.points[2].x(), INFINITY);
  EXPECT_EQ(result.soup.points[2].y(), -INFINITY);
  EXPECT_EQ(result.soup.points[2].z(), 0);
  EXPECT_EQ(result.report.bad_points, 0u);
}

TEST(ReadStl, LettersForNumbersAreCountedAsBadPoint) {
  const std::string text =
      "solid x\nfacet\nouter loop\nvertex 1 2 x\nvertex 1 2\nvertex 4 5 6\nendloop";
  const ReadResult result = read_text(text, "a.stl");
  EXPECT_EQ(result.soup.triangles.size(), 1u);
  EXPECT_EQ(result.report.bad_points, 2u);
  EXPECT_EQ(result.soup.points.back(), Vec3d(4, 5, 6));
  EXPECT_THAT(texts(result.report.warnings).at(0), HasSubstr("line 4"));
}

TEST(ReadStl, LoopOfFourIsAPolygon) {
  const std::string text =
      "solid x\nfacet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 "
      "0\nendloop\n";
  const ReadResult result = read_text(text, "a.stl");
  EXPECT_EQ(result.soup.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(result.report.polygons, 1u);
}

TEST(ReadStl, FacetInWhichTheFileEndsIsLeftOut) {
  const std::string ascii = ascii_tetrahedron();
  const ReadResult result = read_text(ascii.substr(0, ascii.rfind("endloop") - 6), "a.stl");
  EXPECT_EQ(result.soup.triangles.size(), 3u);
  EXPECT_EQ(result.report.bad_faces, 1u);
  EXPECT_THAT(texts(result.report.warnings).at(0), HasSubstr("1 facet left out"));
}

TEST(ReadStl, TextWithoutFacetsIsRefused) {
  EXPECT_EQ(refusal_of("solid empty\nendsolid empty\n", "a.stl"), "a.stl: holds no triangles");
}

TEST(WriteStl, NormalPointsToTheSideFromWhichTheTriangleTurnsLeft) {
  const TriangleSoup soup = {{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}}, {{{0, 1, 2}}}};
  EXPECT_THAT(format_soup(soup, SoupFormat::stl_ascii), HasSubstr("facet normal 0 0 1\n"));
  const std::string binary = format_soup(soup, SoupFormat::stl_binary);
  float z = 0;
  std::memcpy(&z, binary.data() + 84 + 8, sizeof z);
  EXPECT_EQ(z, 1.0f);
}

TEST(WriteStl, BinaryDoesNotBeginWithSolid) {
  EXPECT_FALSE(binary_tetrahedron().starts_with("solid"));
  EXPECT_EQ(binary_tetrahedron().size(), 84u + 4 * 50);
}

TEST(WriteStl, CoordinateBeyondFloatIsRefusedInBinary) {
  TriangleSoup soup = tetrahedron();
  soup.points[0].x() = 1e39;
  EXPECT_THROW(static_cast<void>(format_soup(soup, SoupFormat::stl_binary)), OutputError);
}

// Whatever the threads: the error is about the first coordinate that does not fit.
TEST(WriteStl, NamesTheFirstCoordinateThatIsTooLarge) {
  TriangleSoup soup;
  for (std::uint32_t t = 0; t < 100'000; ++t) {
    for (std::uint32_t k = 0; k < 3; ++k) soup.points.emplace_back(t, k % 2, k / 2);
    soup.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  const std::string fitting = format_soup(soup, SoupFormat::stl_binary);
  EXPECT_EQ(read_soup(std::string_view(fitting), "a", {}).soup.triangles.size(), 100'000U);
  for (std::uint32_t t = 50'000; t < 100'000; ++t) soup.points[3 * t].x() = t * 1e40;
  try {
    (void)format_soup(soup, SoupFormat::stl_binary);
    FAIL();
  } catch (const OutputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("a coordinate of 5e+44 does not fit"));
  }
}

}  // namespace
}  // namespace meshrepair
