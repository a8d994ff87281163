// SPDX-License-Identifier: MIT
// Names of parts of a surface: solids of STL, groups, objects, sets of triangles.
#include <array>
#include <gmock/gmock.h>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <mesh/lost_attributes.h>
#include <mesh/soup_io.h>

#include "expected_in_format.h"
#include "package_bytes.h"
#include "soup_fixtures.h"

namespace meshrepair {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

using Words = std::vector<std::string>;

ReadResult read_named(const std::string& bytes, bool by_mesh = false) {
  ReadOptions options;
  options.attributes = true;
  options.by_mesh = by_mesh;
  return read_soup(std::string_view(bytes), "a", options);
}

Words groups_in(const std::string& bytes) {
  const ReadResult read = read_named(bytes);
  return names_by_triangle(read.attributes.groups, read.soup.triangles.size());
}

std::string facet() {
  return "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
         "endfacet\n";
}

std::string solid(const std::string& name) {
  return "solid " + name + "\n" + facet() + "endsolid " + name + "\n";
}

std::string written(const TriangleSoup& soup, SoupFormat format, const Attributes& attributes) {
  SoupExtras extras;
  const Attributes held = held_by(format, attributes);
  extras.attributes = &held;
  return format_soup(soup, format, extras);
}

TEST(StlNames, SolidsAreGroups) {
  EXPECT_THAT(groups_in(solid("inlet") + solid("out let") + solid("inlet")),
              ElementsAre("inlet", "out let", "inlet"));
  EXPECT_THAT(groups_in(solid("a") + solid("") + facet()), ElementsAre("a", "-", "-"));
  EXPECT_THAT(groups_in("SOLID a\r\n" + facet() + "ENDSOLID\r\nsolid \tb \r\n" + facet()),
              ElementsAre("a", "b"));
  EXPECT_THAT(groups_in(facet() + solid("a")), ElementsAre("-", "a"));
}

TEST(StlNames, NameGoesToTheFacetInItsLine) {
  EXPECT_THAT(groups_in("solid a facet b " + facet() + "endsolid solid facet normal b\n" + facet()),
              ElementsAre("a facet b", "-"));
}

TEST(StlNames, EndMaySayTheName) {
  EXPECT_THAT(
      groups_in("solid\n" + facet() + "endsolid a\n" + "solid b\n" + facet() + "endsolid\n"),
      ElementsAre("a", "b"));
}

TEST(StlNames, OneNameIsNoGroupAndStays) {
  for (const std::string& bytes : {solid("a b"), solid("a b") + solid("a b")}) {
    const ReadResult read = read_named(bytes);
    EXPECT_TRUE(read.attributes.is_bare());
    EXPECT_THAT(written(read.soup, SoupFormat::stl_ascii, read.attributes),
                ::testing::StartsWith("solid a b\n"));
  }
  EXPECT_TRUE(read_named(solid("")).attributes.empty());
}

TEST(StlNames, GroupsBecomeSolidsInTheirOrder) {
  const ReadResult read = read_named(solid("b") + solid("a") + solid("") + solid("b"));
  const std::string bytes = written(read.soup, SoupFormat::stl_ascii, read.attributes);
  EXPECT_THAT(groups_in(bytes), ElementsAre("b", "b", "a", "-"));
  EXPECT_EQ(replaced(bytes, "solid b\n", "").size() + 2 * std::string("solid b\n").size(),
            bytes.size());
}

TEST(StlNames, SolidsAreMeshesOfAScene) {
  const ReadResult read = read_named(solid("a") + solid("b") + solid("a"), true);
  ASSERT_EQ(read.scene.meshes.size(), 2u);
  EXPECT_EQ(read.scene.meshes[0].name, "a");
  EXPECT_EQ(read.scene.meshes[0].triangles, 2u);
  EXPECT_EQ(read.scene.meshes[1].name, "b");
}

std::string with_words(const std::array<std::uint16_t, 4>& words) {
  std::string bytes = format_soup(tetrahedron(), SoupFormat::stl_binary);
  for (std::size_t t = 0; t < words.size(); ++t) {
    bytes.replace(84 + 50 * t + 48, 2, little_endian(words[t], 2));
  }
  return bytes;
}

TEST(StlNames, WordsThatAreNoColoursAreGroups) {
  const std::string bytes = with_words({7, 0, 300, 7});
  const ReadResult read = read_named(bytes);
  EXPECT_THAT(groups_in(bytes), ElementsAre("7", "-", "300", "7"));
  EXPECT_EQ(written(read.soup, SoupFormat::stl_binary, read.attributes), bytes);
}

TEST(StlNames, OneWordForAllIsNoGroup) {
  EXPECT_TRUE(read_named(with_words({0, 0, 0, 0})).attributes.empty());
  EXPECT_TRUE(read_named(with_words({2, 2, 2, 2})).attributes.empty());
}

TEST(StlNames, WordsWithTheTopBitAreColours) {
  const Attributes attributes = read_named(with_words({7, 0, 0x8007, 7})).attributes;
  EXPECT_TRUE(attributes.groups.empty());
  EXPECT_EQ(attributes.corners.size(), 1u);
}

TEST(StlNames, BinaryHoldsNumbersAlone) {
  Attributes attributes;
  attributes.groups = {{"7", "x"}, {0, 0, 1, kNone}};
  const TriangleSoup soup = tetrahedron();
  const auto lost_in = [&](SoupFormat format) {
    return lost_attributes(soup, attributes, held_by(format, attributes), format);
  };
  EXPECT_THAT(lost_in(SoupFormat::stl_binary), ElementsAre("groups"));
  EXPECT_THAT(lost_in(SoupFormat::off), ElementsAre("groups"));
  for (const SoupFormat format : {SoupFormat::stl_ascii, SoupFormat::obj, SoupFormat::ply_binary,
                                  SoupFormat::glb, SoupFormat::threemf}) {
    EXPECT_THAT(lost_in(format), IsEmpty()) << format_name(format);
  }
  for (const char* const number : {"0", "07", "32768", "-1", "+1", "1 ", "1e3"}) {
    attributes.groups.names[1] = number;
    EXPECT_THAT(lost_in(SoupFormat::stl_binary), ElementsAre("groups")) << number;
  }
  attributes.groups.names[1] = "32767";
  EXPECT_THAT(lost_in(SoupFormat::stl_binary), IsEmpty());
}

TEST(Names, TheFinerListIsHeldWhereThereIsOne) {
  Attributes attributes;
  attributes.groups = {{"g"}, {0, 0, 0, kNone}};
  attributes.objects = {{"a", "b"}, {0, 1, kNone, 1}};
  const TriangleSoup soup = tetrahedron();
  const Attributes held = held_by(SoupFormat::glb, attributes);
  EXPECT_THAT(names_by_triangle(held.objects, 4), ElementsAre("a", "b", "g", "b"));
  EXPECT_TRUE(held.groups.empty());
  attributes.objects.of_triangle = {0, 0, 0, 1};
  attributes.groups = {{"g", "h"}, {0, 0, 1, 1}};
  EXPECT_THAT(groups_in(written(soup, SoupFormat::stl_ascii, attributes)),
              ElementsAre("g", "g", "h", "h"));
  EXPECT_THAT(lost_attributes(soup, attributes, held_by(SoupFormat::stl_ascii, attributes),
                              SoupFormat::stl_ascii),
              ElementsAre("objects"));
}

TEST(Names, OddNamesStayApartAndHarmNoFile) {
  const Words names = {"a b",
                       " a",
                       "a ",
                       "a\nfacet normal 0 0 1",
                       "facet normal",
                       "#a",
                       "\xFF",
                       "<&\"'>",
                       "a\\",
                       std::string("z\0z", 3),
                       "-",
                       "endsolid",
                       "v 1",
                       "\xE2\x82\xAC",
                       "end_header"};
  TriangleSoup soup = tetrahedron();
  Attributes attributes;
  attributes.groups.names = names;
  while (soup.triangles.size() < names.size()) soup.triangles.push_back({0, 1, 2});
  for (std::uint32_t t = 0; t < names.size(); ++t) attributes.groups.of_triangle.push_back(t);
  for (const SoupFormat format :
       {SoupFormat::stl_ascii, SoupFormat::obj, SoupFormat::ply_ascii, SoupFormat::ply_binary,
        SoupFormat::glb, SoupFormat::gltf, SoupFormat::threemf}) {
    SCOPED_TRACE(std::string(format_name(format)));
    const ReadResult read = read_named(written(soup, format, attributes));
    EXPECT_THAT(read.report.warnings, IsEmpty());
    ASSERT_EQ(read.soup.triangles.size(), names.size());
    const bool is_gltf_format = is_gltf(format);
    const TriangleLabels& labels =
        is_gltf_format ? read.attributes.objects : read.attributes.groups;
    const Words back = names_by_triangle(labels, names.size());
    EXPECT_EQ(std::set<std::string>(back.begin(), back.end()).size(), names.size());
    EXPECT_EQ(back[0], "a b");
    EXPECT_EQ(back[13], "\xE2\x82\xAC");
  }
}

TEST(Names, SetsOfTrianglesThatAreOdd) {
  const auto sets_of = [](const std::string& sets) {
    const std::string space = "http://schemas.microsoft.com/3dmanufacturing/trianglesets/2021/07";
    return groups_in(package_of(model_of(replaced(tetrahedron_object(1), "</triangles>",
                                                  "</triangles><t:trianglesets xmlns:t=\"" + space +
                                                      "\">" + sets + "</t:trianglesets>"),
                                         item_of(1))));
  };
  const auto set = [](const std::string& name, const std::string& refs) {
    return "<t:triangleset name=\"" + name + "\" identifier=\"i\">" + refs + "</t:triangleset>";
  };
  // A triangle is of the first set that has it.
  EXPECT_THAT(sets_of(set("a", "<t:refrange startindex=\"0\" endindex=\"1\"/>") +
                      set("b", "<t:ref index=\"1\"/><t:ref index=\"3\"/>")),
              ElementsAre("a", "a", "-", "b"));
  EXPECT_THAT(sets_of(set("a",
                          "<t:refrange startindex=\"2\" endindex=\"2147483646\"/>"
                          "<t:ref index=\"4\"/><t:ref/><t:ref index=\"-1\"/>"
                          "<t:refrange startindex=\"1\" endindex=\"0\"/>") +
                      set("", "<t:ref index=\"0\"/>")),
              ElementsAre("-", "-", "a", "a"));
  std::string many;
  for (int i = 0; i < 20000; ++i) many += "<t:refrange startindex=\"0\" endindex=\"3\"/>";
  EXPECT_THAT(sets_of(set("a", many)), ElementsAre("a", "a", "a", "a"));
}

}  // namespace
}  // namespace meshrepair
