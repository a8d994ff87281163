// SPDX-License-Identifier: MIT
// Attributes of several 3MF packages as one.
#include <gmock/gmock.h>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include <mesh/soup_io.h>

#include "formats/common/zip_reader.h"
#include "package_bytes.h"
#include "soup_fixtures.h"
#include "threemf_soups.h"
#include "warning_texts.h"

namespace meshrepair {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using Kind = CornerAttribute::Kind;

ReadResult read_package(const std::string& bytes) {
  ReadOptions options;
  options.attributes = true;
  return read_soup(std::string_view(bytes), "a.3mf", options);
}

void append_package(ReadResult& all, const std::string& bytes) {
  ReadResult other = read_package(bytes);
  append_attributes(all.attributes, all.soup.triangles.size(), std::move(other.attributes),
                    other.soup.triangles.size());
  const auto base = static_cast<std::uint32_t>(all.soup.points.size());
  for (const Vec3d& point : other.soup.points) all.soup.points.push_back(point);
  for (const auto& [a, b, c] : other.soup.triangles) {
    all.soup.triangles.push_back({a + base, b + base, c + base});
  }
}

std::string write_package(const ReadResult& read) {
  return format_soup(read.soup, SoupFormat::threemf, {.attributes = &read.attributes});
}

PackageParts parts_in(const std::string& bytes) {
  const MeshSource source{bytes, "a.3mf"};
  ZipReader archive(source);
  PackageParts parts;
  for (const ZipReader::Entry& entry : archive.entries()) {
    parts.emplace_back(entry.name, archive.text_of(entry));
  }
  return parts;
}

// A triangle with a picture of which all packages have one of this name.
std::string textured_package(const std::string& picture, const std::string& tiling) {
  const std::string resources =
      "<m:texture2d id=\"1\" path=\"/3D/Textures/paint.png\" contenttype=\"image/png\" " + tiling +
      "/><m:texture2dgroup id=\"2\" texid=\"1\"><m:tex2coord u=\"0\" v=\"0\"/>"
      "<m:tex2coord u=\"1\" v=\"0\"/><m:tex2coord u=\"0\" v=\"1\"/></m:texture2dgroup>" +
      object_of(3, "<triangle v1=\"0\" v2=\"2\" v3=\"1\" pid=\"2\" p1=\"0\" p2=\"1\" p3=\"2\"/>");
  return package_of(model_of(resources, item_of(3)), {{"3D/Textures/paint.png", picture}});
}

TEST(JoinedPackages, PicturesOfOneNameAndTheirTilingsStayApart) {
  ReadResult all = read_package(textured_package(tiny_png(1), "tilestyleu=\"mirror\""));
  append_package(all, textured_package(tiny_png(2), "tilestyleu=\"clamp\""));
  append_package(all, textured_package(tiny_png(1), "tilestylev=\"none\" filter=\"nearest\""));
  append_package(all, textured_package(tiny_png(1), "tilestyleu=\"mirror\""));
  EXPECT_THAT(all.attributes.materials.of_triangle, ElementsAre(0u, 1u, 2u, 0u));
  const ReadResult again = read_package(write_package(all));
  EXPECT_THAT(again.attributes.materials.of_triangle, ElementsAre(0u, 1u, 2u, 0u));
  ASSERT_EQ(again.attributes.images.size(), 3u);
  EXPECT_EQ(*again.attributes.images[0].bytes, tiny_png(1));
  EXPECT_EQ(*again.attributes.images[1].bytes, tiny_png(2));
  const std::string model = parts_in(write_package(all))[2].second;
  EXPECT_THAT(model, HasSubstr("tilestyleu=\"mirror\""));
  EXPECT_THAT(model, HasSubstr("tilestyleu=\"clamp\""));
  EXPECT_THAT(model, HasSubstr("tilestylev=\"none\" filter=\"nearest\""));
}

std::string coloured_package(const std::string& colour) {
  return package_of(model_of("<m:colorgroup id=\"1\"><m:color color=\"" + colour +
                                 "\"/></m:colorgroup>" +
                                 object_of(2,
                                           "<triangle v1=\"0\" v2=\"2\" v3=\"1\" pid=\"1\" "
                                           "p1=\"0\"/>"),
                             item_of(2)));
}

TEST(JoinedPackages, ColoursWithAndWithoutOpacityAreOneSet) {
  for (const bool opaque_first : {true, false}) {
    ReadResult all = read_package(coloured_package(opaque_first ? "#FF0000" : "#0000FF33"));
    append_package(all, coloured_package(opaque_first ? "#0000FF33" : "#FF0000"));
    ASSERT_EQ(all.attributes.corners.size(), 1u);
    const ReadResult again = read_package(write_package(all));
    const CornerAttribute* const colours = find_kind(again.attributes, Kind::colour);
    ASSERT_NE(colours, nullptr);
    const std::uint32_t red = colours->of_corner[opaque_first ? 0 : 3];
    const std::uint32_t blue = colours->of_corner[opaque_first ? 3 : 0];
    ASSERT_TRUE(red != kNone && blue != kNone);
    EXPECT_EQ(colours->values[4 * red], 1);
    EXPECT_EQ(colours->values[4 * red + 3], 1);
    EXPECT_EQ(colours->values[4 * blue + 2], 1);
    EXPECT_EQ(colours->values[4 * blue + 3], 0x33 / 255.0);
  }
}

// With parts that the package refers to, and one that is known by its name.
std::string package_with_parts(const std::string& text) {
  const std::string type = "Type=\"http://maker.example/notes\"/>";
  const std::string relationships = replaced(
      kRelationships, "</Relationships>",
      "<Relationship Target=\"/Metadata/thumbnail.png\" Id=\"r1\" Type=\"http://"
      "schemas.openxmlformats.org/package/2006/relationships/metadata/thumbnail\"/>"
      "<Relationship Target=\"/Other/notes.txt\" Id=\"r2\" " +
          type + "<Relationship Target=\"/Other/same.txt\" Id=\"r3\" " + type + "</Relationships>");
  return zip_of({{"_rels/.rels", relationships},
                 {"3D/3dmodel.model", model_of(tetrahedron_object(1), item_of(1))},
                 {"Metadata/thumbnail.png", tiny_png(7) + text},
                 {"Metadata/settings.config", "settings of " + text},
                 {"Other/same.txt", "the same"},
                 {"Other/notes.txt", text}});
}

TEST(JoinedPackages, PartsOfOneNameGetDifferentNames) {
  ReadResult all = read_package(package_with_parts("one"));
  append_package(all, package_with_parts("two"));
  append_package(all, package_with_parts("two"));
  const std::string bytes = write_package(all);
  const PackageParts parts = parts_in(bytes);
  const auto names = [&] {
    std::vector<std::string> list;
    for (const auto& [name, text] : parts) list.push_back(name);
    return list;
  }();
  EXPECT_THAT(names, ElementsAre("[Content_Types].xml", "_rels/.rels", "3D/3dmodel.model",
                                 "Metadata/thumbnail.png", "Metadata/settings.config",
                                 "Other/same.txt", "Other/notes.txt", "Other/notes_2.txt"));
  EXPECT_EQ(parts[4].second, "settings of one");
  EXPECT_EQ(parts[7].second, "two");
  EXPECT_THAT(parts[1].second, HasSubstr("/Other/notes_2.txt"));
  EXPECT_THAT(texts(read_package(bytes).report.warnings), ElementsAre());
}

}  // namespace
}  // namespace meshrepair
