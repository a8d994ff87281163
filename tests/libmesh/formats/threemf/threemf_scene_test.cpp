// Objects of a package one by one, and the build that they come back to.
#include <gmock/gmock.h>
#include <string>

#include <gtest/gtest.h>

#include <mesh/soup_io.h>

#include "formats/common/zip_reader.h"
#include "package_bytes.h"
#include "soup_fixtures.h"
#include "threemf_peer.h"

namespace meshrepair {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

ReadResult read_by_mesh(const std::string& bytes, bool attributes) {
  ReadOptions options;
  options.by_mesh = true;
  options.attributes = attributes;
  return read_soup(std::string_view(bytes), "a.3mf", options);
}

std::string written(const ReadResult& read) {
  SoupExtras extras;
  extras.attributes = &read.attributes;
  extras.scene = &read.scene;
  return format_soup(read.soup, SoupFormat::threemf, extras);
}

void expect_same_build(const std::string& package, std::size_t meshes, std::size_t instances) {
  const TriangleSoup before = read_soup(std::string_view(package), "a.3mf").soup;
  for (const bool attributes : {false, true}) {
    const ReadResult read = read_by_mesh(package, attributes);
    EXPECT_EQ(read.scene.meshes.size(), meshes);
    EXPECT_EQ(read.scene.instances.size(), instances);
    EXPECT_EQ(read.soup.triangles.size(), 4 * meshes);
    const std::string again = written(read);
    const TriangleSoup after = read_soup(std::string_view(again), "b.3mf").soup;
    EXPECT_EQ(after.points, before.points);
    EXPECT_EQ(after.triangles, before.triangles);
    EXPECT_EQ(written(read_by_mesh(again, attributes)), again);
  }
}

TEST(ThreemfScene, ComponentsAndItemsStay) {
  const std::string move = "transform=\"1 0 0 0 1 0 0 0 1 1 0 0\"";
  const std::string scale = "transform=\"2 0 0 0 2 0 0 0 2 0 0 0\"";
  const std::string mirror = "transform=\"-1 0 0 0 1 0 0 0 1 0 100 0\"";
  expect_same_build(
      package_of(model_of(tetrahedron_object(1, "name=\"leg\"") + tetrahedron_object(7) +
                              assembly_of(8, component_of(1, move) + component_of(1)) +
                              assembly_of(9, component_of(8, scale) + component_of(7)),
                          item_of(9, mirror) + item_of(1), "unit=\"inch\"")),
      2, 4);
}

TEST(ThreemfScene, NamesAndUnitsStay) {
  const ReadResult read = read_by_mesh(
      package_of(model_of(tetrahedron_object(1, "name=\"leg\""), item_of(1), "unit=\"inch\"")),
      true);
  EXPECT_EQ(read.report.unit, LengthUnit::inch);
  EXPECT_EQ(read.scene.meshes[0].name, "leg");
  const ReadResult again = read_by_mesh(written(read), true);
  EXPECT_EQ(again.report.unit, LengthUnit::inch);
  EXPECT_EQ(again.scene.meshes[0].name, "leg");
}

std::string uuid_of(int number) {
  return "p:UUID=\"0123abCD-0000-0000-0000-00000000000" + std::to_string(number) + "\"";
}

std::string model_in(const std::string& package) {
  const MeshSource source{package, "a.3mf"};
  ZipReader archive(source);
  return archive.text_of(*archive.find("3D/3dmodel.model"));
}

// Objects, components, items and a build, and by what other programs know them.
std::string marked_package() {
  const std::string thumbnail = "thumbnail=\"/Thumbnails/a_leg.png\"";
  std::string model = model_of(
      tetrahedron_object(1, "name=\"leg\" type=\"surface\" partnumber=\"L &amp; 1\" " + thumbnail +
                                " " + uuid_of(1)) +
          tetrahedron_object(2, "type=\"nonsense\" thumbnail=\"/none.png\" p:UUID=\"1234\"") +
          "<object id=\"3\" name=\"table\" partnumber=\"T\" " + uuid_of(3) + "><components>" +
          component_of(1, uuid_of(4)) + component_of(2) + "</components></object>",
      item_of(3, "partnumber=\"I\" " + uuid_of(5)) + item_of(2));
  model = replaced(model, "<build>", "<build " + uuid_of(6) + ">");
  const std::string links =
      "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">"
      "<Relationship Target=\"/Thumbnails/a_leg.png\" Id=\"r1\" Type=\"http://"
      "schemas.openxmlformats.org/package/2006/relationships/metadata/thumbnail\"/>"
      "</Relationships>";
  return package_of(model, {{"3D/_rels/3dmodel.model.rels", links},
                            {"Thumbnails/a_leg.png", "\x89PNG\r\n\x1A\n"}});
}

TEST(ThreemfScene, WhatProgramsKnowObjectsByStays) {
  const ReadResult read = read_by_mesh(marked_package(), true);
  EXPECT_EQ(written(read_by_mesh(written(read), true)), written(read));
  EXPECT_EQ(read_by_peer(written(read), false).warnings, "");
  const std::string model = model_in(written(read));
  for (const std::string& part :
       {"<object id=\"1\" type=\"surface\" name=\"leg\" thumbnail=\"/Thumbnails/a_leg.png\" "
        "partnumber=\"L &amp; 1\" " +
            uuid_of(1) + ">",
        std::string("<object id=\"2\" type=\"model\">"),
        "<object id=\"3\" type=\"model\" name=\"table\" partnumber=\"T\" " + uuid_of(3) + ">",
        "<component objectid=\"1\" " + uuid_of(4) + "/>",
        "<item objectid=\"3\" partnumber=\"I\" " + uuid_of(5) + "/>", "<build " + uuid_of(6) + ">",
        std::string("xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06")}) {
    EXPECT_THAT(model, HasSubstr(part));
  }
}

TEST(ThreemfScene, ThumbnailsGoWithOtherPartsOfThePackage) {
  const std::string model = model_in(written(read_by_mesh(marked_package(), false)));
  EXPECT_THAT(model, HasSubstr("partnumber=\"L &amp; 1\" " + uuid_of(1)));
  EXPECT_THAT(model, Not(HasSubstr("thumbnail")));
}

TEST(ThreemfScene, MeshesThatBecameEmptyAreLeftOut) {
  ReadResult read = read_by_mesh(
      package_of(model_of(tetrahedron_object(1) + tetrahedron_object(2) +
                              assembly_of(3, component_of(1)) + assembly_of(4, component_of(2)),
                          item_of(3) + item_of(4))),
      false);
  ASSERT_EQ(read.scene.meshes.size(), 2u);
  read.scene.meshes[0] = {"", 0, 0};
  read.soup = meshes_of(read.soup, {{{"", 0, 0}, {"", 4, 4}}, {}})[1];
  const TriangleSoup after = read_soup(std::string_view(written(read)), "b.3mf").soup;
  EXPECT_EQ(after.triangles.size(), 4u);
}

}  // namespace
}  // namespace meshrepair
