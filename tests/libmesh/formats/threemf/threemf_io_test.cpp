// SPDX-License-Identifier: MIT
// What 3MF can hold comes back as it was.
#include <algorithm>
#include <cstdlib>
#include <gmock/gmock.h>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include <mesh/soup_io.h>

#include "each_seed.h"
#include "package_bytes.h"
#include "soup_fixtures.h"
#include "temporary_folder.h"
#include "threemf_soups.h"
#include "warning_texts.h"

namespace meshrepair {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::UnorderedElementsAre;
using Kind = CornerAttribute::Kind;

ReadResult read_all(const std::string& bytes) {
  ReadOptions options;
  options.attributes = true;
  return read_soup(std::string_view(bytes), "a.3mf", options);
}

std::string write_all(const TriangleSoup& soup, const Attributes& attributes,
                      const std::vector<std::string>& comments = {}) {
  return format_soup(soup, SoupFormat::threemf, {.comments = comments, .attributes = &attributes});
}

std::string name_at(const TriangleLabels& labels, std::size_t t) {
  const std::uint32_t label = labels.empty() ? kNone : labels.of_triangle[t];
  return label == kNone ? std::string("-") : labels.names[label];
}

// Of all corners, "-" where there is none.
std::vector<std::vector<double>> values_at_corners(const Attributes& attributes, Kind kind,
                                                   std::size_t corners) {
  std::vector<std::vector<double>> values(corners);
  const CornerAttribute* const given = find_kind(attributes, kind);
  for (std::size_t i = 0; given != nullptr && i < corners; ++i) {
    if (given->of_corner[i] == kNone) continue;
    const auto* const first = given->values.data() + given->components * given->of_corner[i];
    values[i].assign(first, first + given->components);
  }
  return values;
}

void expect_same_look(const Attributes& a, const Attributes& b, std::uint32_t m) {
  EXPECT_EQ(a.looks[m].colour, b.looks[m].colour);
  ASSERT_EQ(a.looks[m].image == kNone, b.looks[m].image == kNone);
  if (a.looks[m].image == kNone) return;
  const Image& one = a.images[a.looks[m].image];
  const Image& other = b.images[b.looks[m].image];
  EXPECT_EQ(*one.bytes, *other.bytes);
  EXPECT_EQ(one.media_type, other.media_type);
}

void expect_same_attributes(const Attributes& a, const Attributes& b, std::size_t triangles) {
  for (std::size_t t = 0; t < triangles; ++t) {
    ASSERT_EQ(name_at(a.materials, t), name_at(b.materials, t)) << t;
  }
  for (const Kind kind : {Kind::texture, Kind::colour}) {
    EXPECT_EQ(values_at_corners(a, kind, 3 * triangles), values_at_corners(b, kind, 3 * triangles));
  }
}

TEST(Threemf, RandomSoupsComeBackBitForBit) {
  for_each_seed(20, [&](std::uint64_t seed) {
    const TriangleSoup soup = random_soup(seed, false);
    const ReadResult back = read_all(format_soup(soup, SoupFormat::threemf));
    EXPECT_EQ(point_bits(back.soup), point_bits(soup));
    EXPECT_EQ(back.soup.triangles, soup.triangles);
    EXPECT_THAT(texts(back.report.warnings), ElementsAre());
  });
}

TEST(Threemf, MaterialsColoursAndTexturesComeBackBitForBit) {
  for_each_seed(200, [&](std::uint64_t seed) {
    const ThreemfSoup made = random_threemf_soup(seed);
    const std::string bytes = write_all(made.soup, made.attributes);
    const ReadResult back = read_all(bytes);
    EXPECT_THAT(texts(back.report.warnings), ElementsAre());
    EXPECT_EQ(back.soup.triangles, made.soup.triangles);
    EXPECT_EQ(point_bits(back.soup), point_bits(made.soup));
    expect_same_attributes(back.attributes, made.attributes, made.soup.triangles.size());
    EXPECT_EQ(back.attributes.materials.of_triangle, made.attributes.materials.of_triangle);
    for (std::uint32_t m = 0; m < made.attributes.looks.size(); ++m) {
      expect_same_look(back.attributes, made.attributes, m);
    }
    EXPECT_EQ(write_all(back.soup, back.attributes), bytes);
  });
}

TEST(Threemf, AttributesAreReadOnlyIfAskedFor) {
  const ThreemfSoup made = random_threemf_soup(1);
  const std::string bytes = write_all(made.soup, made.attributes);
  EXPECT_TRUE(read_soup(std::string_view(bytes), "a").attributes.empty());
}

TEST(Threemf, GoesThroughObjAndBack) {
  for_each_seed(10, [&](std::uint64_t seed) {
    ThreemfSoup made = random_threemf_soup(seed);
    made.attributes.corners.pop_back();  // OBJ has colours for points alone
    const TemporaryFolder folder;
    WriteOptions options;
    options.extras.attributes = &made.attributes;
    write_soup(made.soup, folder.path() / "a.obj", options);
    ReadOptions all;
    all.attributes = true;
    const ReadResult as_obj = read_soup(folder.path() / "a.obj", all);
    const ReadResult back = read_all(write_all(as_obj.soup, as_obj.attributes));
    EXPECT_EQ(point_bits(back.soup), point_bits(made.soup));
    const std::size_t triangles = made.soup.triangles.size();
    for (std::size_t t = 0; t < triangles; ++t) {
      EXPECT_EQ(name_at(back.attributes.materials, t), name_at(made.attributes.materials, t));
    }
    EXPECT_EQ(values_at_corners(back.attributes, Kind::texture, 3 * triangles),
              values_at_corners(made.attributes, Kind::texture, 3 * triangles));
    // In another order: OBJ has materials as they are used first.
    std::vector<std::string> pictures;
    for (const Image& image : back.attributes.images) pictures.push_back(*image.bytes);
    EXPECT_THAT(pictures, UnorderedElementsAre(tiny_png(0), tiny_png(1)));
  });
}

TEST(Threemf, OnlyPicturesGetIntoAPackage) {
  ThreemfSoup made = random_threemf_soup(0);
  made.attributes.images[0] = {"passwd", "image/png", "/etc/passwd", nullptr};
  made.attributes.images[1] = {"none.png", "image/png", "/no/such/file.png", nullptr};
  const ReadResult back = read_all(write_all(made.soup, made.attributes));
  EXPECT_TRUE(back.attributes.images.empty());
  EXPECT_EQ(back.attributes.materials.of_triangle, made.attributes.materials.of_triangle);
}

TEST(Threemf, SameInputSameBytes) {
  const ThreemfSoup made = random_threemf_soup(5);
  const std::string bytes = write_all(made.soup, made.attributes, {"one", "two"});
  ::setenv("TZ", "Pacific/Kiritimati", 1);
  ::tzset();
  EXPECT_EQ(write_all(made.soup, made.attributes, {"one", "two"}), bytes);
  ::unsetenv("TZ");
  ::tzset();
}

TEST(Threemf, CommentsAreTheDescription) {
  const std::string bytes = format_soup(tetrahedron(), SoupFormat::threemf, {{"a < b", "c"}});
  const ReadResult back = read_all(bytes);
  EXPECT_THAT(texts(read_all(write_all(back.soup, back.attributes, {"d"})).report.warnings),
              ElementsAre());
}

TEST(Threemf, CoordinatesThatAreNoNumbersAreNotWritten) {
  TriangleSoup soup = tetrahedron();
  soup.points[2].y() = std::numeric_limits<double>::infinity();
  EXPECT_THROW((void)format_soup(soup, SoupFormat::threemf), OutputError);
}

TEST(Threemf, OtherPartsUnitAndMetadataAreKept) {
  const std::string relationships =
      replaced(kRelationships, "</Relationships>",
               "<Relationship Target=\"/Metadata/thumbnail.png\" Id=\"r1\" Type=\"http://"
               "schemas.openxmlformats.org/package/2006/relationships/metadata/thumbnail\"/>"
               "</Relationships>");
  std::string model = model_of(tetrahedron_object(1), item_of(1),
                               "unit=\"inch\" xmlns:maker=\"http://maker.example/2026\"");
  model = replaced(model, "<resources>",
                   "<metadata name=\"Title\" preserve=\"1\">A &amp; B</metadata>"
                   "<metadata name=\"maker:Version\">7</metadata><resources>");
  const std::string settings(5000, 'x');
  const std::string bytes =
      zip_of({{"_rels/.rels", relationships},
              {"3D/3dmodel.model", model},
              {"Metadata/thumbnail.png", tiny_png(7)},
              {"Metadata/project_settings.config", settings},
              {"Metadata/model_settings.config", "<config><object id=\"1\"/></config>"},
              {"Metadata/plate_1.gcode", "G28"}});
  const ReadResult first = read_all(bytes);
  EXPECT_THAT(texts(first.report.warnings), ElementsAre(HasSubstr("2 parts of the package")));
  const std::string again = write_all(first.soup, first.attributes);
  const ReadResult second = read_all(again);
  EXPECT_THAT(texts(second.report.warnings), ElementsAre());
  EXPECT_EQ(write_all(second.soup, second.attributes), again);
  EXPECT_THAT(again, HasSubstr("Metadata/thumbnail.png"));
  EXPECT_THAT(again, HasSubstr("Metadata/project_settings.config"));
  EXPECT_THAT(again, Not(HasSubstr("model_settings.config")));
  EXPECT_THAT(again, Not(HasSubstr("gcode")));
  EXPECT_THAT(again, HasSubstr(tiny_png(7)));  // stored
}

TEST(Threemf, PropertiesOfTheObjectHoldWhereTrianglesSayNothing) {
  const std::string resources =
      "<basematerials id=\"5\"><base name=\"a\" displaycolor=\"#FF0000\"/>"
      "<base name=\"b\" displaycolor=\"#00FF0080\"/></basematerials>" +
      object_of(1,
                "<triangle v1=\"0\" v2=\"2\" v3=\"1\"/>"
                "<triangle v1=\"0\" v2=\"1\" v3=\"3\" p1=\"0\"/>"
                "<triangle v1=\"1\" v2=\"2\" v3=\"3\" pid=\"6\" p1=\"0\"/>",
                "pid=\"5\" pindex=\"1\"");
  const ReadResult result = read_all(package_of(model_of(resources, item_of(1))));
  const TriangleLabels& materials = result.attributes.materials;
  EXPECT_EQ(name_at(materials, 0), "b");
  EXPECT_EQ(name_at(materials, 1), "a");
  EXPECT_EQ(name_at(materials, 2), "-");
  EXPECT_EQ(result.attributes.looks[1].colour[3], 128 / 255.0);
  EXPECT_THAT(texts(result.report.warnings),
              ElementsAre("1 triangle with properties that are not there"));
}

TEST(Threemf, MaterialsOfOneNameAreToldApart) {
  const std::string base = "<base name=\"a\" displaycolor=\"#FF0000\"/>";
  const std::string resources = "<basematerials id=\"5\">" + base + base +
                                "<base name=\"a 2\" displaycolor=\"#FF0000\"/></basematerials>" +
                                tetrahedron_object(1, "pid=\"5\" pindex=\"0\"");
  const ReadResult result = read_all(package_of(model_of(resources, item_of(1))));
  EXPECT_THAT(result.attributes.materials.names, ElementsAre("a", "a 2", "a 2 2"));
}

TEST(Threemf, LayersOfPropertiesAreTakenApart) {
  const std::string resources =
      "<basematerials id=\"5\"><base name=\"a\" displaycolor=\"#FF0000\"/></basematerials>"
      "<m:colorgroup id=\"6\"><m:color color=\"#000000\"/><m:color color=\"#0000FF\"/>"
      "</m:colorgroup><m:multiproperties id=\"7\" pids=\"5 6\"><m:multi pindices=\"0 1\"/>"
      "<m:multi pindices=\"0\"/></m:multiproperties>"
      "<m:compositematerials id=\"8\" matid=\"5\" matindices=\"0\"><m:composite values=\"1\"/>"
      "</m:compositematerials>" +
      object_of(1, "<triangle v1=\"0\" v2=\"2\" v3=\"1\" pid=\"7\" p1=\"0\" p2=\"1\" p3=\"1\"/>");
  const ReadResult result = read_all(package_of(model_of(resources, item_of(1))));
  EXPECT_EQ(name_at(result.attributes.materials, 0), "a");
  EXPECT_THAT(find_kind(result.attributes, Kind::colour)->of_corner, ElementsAre(1u, 0u, 0u));
  EXPECT_THAT(texts(result.report.warnings),
              ElementsAre(HasSubstr("1 group of properties left out")));
}

}  // namespace
}  // namespace meshrepair
