// SPDX-License-Identifier: MIT
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

// What slicers and other programs say of objects and items.
std::string package_with_metadata() {
  const std::string group =
      "<metadatagroup><metadata name=\"Title\" preserve=\"1\">a &lt; b</metadata><metadata "
      "name=\"x:kind\" type=\"xs:string\">K</metadata><metadata name=\"y:lost\">no space</metadata>"
      "<metadata name=\"Title\">again</metadata></metadatagroup>";
  std::string model =
      model_of(replaced(tetrahedron_object(1), "<mesh>", group + "<mesh>") + "<object id=\"3\">" +
                   group + "<components>" + component_of(1) + "</components></object>",
               "<item objectid=\"3\" printable=\"0\">" + group + "</item>" + item_of(1) +
                   item_of(1, "printable=\"maybe\""));
  model = replaced(model, "<model ", "<model xmlns:x=\"urn:x\" xmlns:xs=\"urn:xs\" ");
  return package_of(model);
}

TEST(ThreemfScene, MetadataOfObjectsAndItemsStay) {
  const ReadResult read = read_by_mesh(package_with_metadata(), true);
  EXPECT_EQ(written(read_by_mesh(written(read), true)), written(read));
  EXPECT_EQ(read_by_peer(written(read), false).warnings, "");
  const std::string model = model_in(written(read));
  const std::string group =
      ">\n<metadatagroup>\n<metadata name=\"Title\" preserve=\"1\">a &lt; b</metadata>\n"
      "<metadata name=\"x:kind\" type=\"xs:string\">K</metadata>\n</metadatagroup>\n";
  EXPECT_THAT(model, HasSubstr("<object id=\"1\" type=\"model\"" + group + "<mesh>"));
  EXPECT_THAT(model, HasSubstr("<object id=\"3\" type=\"model\"" + group + "<components>"));
  EXPECT_THAT(model, HasSubstr("<item objectid=\"3\" printable=\"0\"" + group + "</item>"));
  EXPECT_THAT(model, HasSubstr("<item objectid=\"1\"/>\n<item objectid=\"1\"/>"));
  EXPECT_THAT(model, HasSubstr("xmlns:x=\"urn:x\""));
  EXPECT_THAT(read.attributes.keepsake->lost_in(SoupFormat::glb),
              ::testing::ElementsAre("metadata", "what is not to be printed"));
}

TEST(ThreemfScene, PrefixesOfOtherPartsMeanWhatTheyMeant) {
  const auto object = [](const std::string& name) {
    return replaced(
        tetrahedron_object(1), "<mesh>",
        "<metadatagroup><metadata name=\"" + name + "\">v</metadata></metadatagroup><mesh>");
  };
  const auto declared = [](const std::string& model, const std::string& what) {
    return replaced(model, "<model ", "<model " + what + " ");
  };
  const std::string package =
      package_of(declared(model_of(object("x:a"), item_of(1) + item_of(1, "p:path=\"/b.model\"") +
                                                      item_of(1, "p:path=\"/c.model\"")),
                          "xmlns:x=\"urn:x\""),
                 {{"b.model", declared(model_of(object("x:b")), "xmlns:x=\"urn:other\"")},
                  {"c.model", declared(model_of(object("z:c")), "xmlns:z=\"urn:z\"")}});
  const std::string model = model_in(written(read_by_mesh(package, true)));
  EXPECT_THAT(model, HasSubstr("\"x:a\""));
  EXPECT_THAT(model, Not(HasSubstr("\"x:b\"")));
  EXPECT_THAT(model, HasSubstr("\"z:c\""));
  EXPECT_THAT(model, HasSubstr("xmlns:z=\"urn:z\""));
}

TEST(ThreemfScene, ThumbnailsThatOnlyThePackageNamesStay) {
  const std::string link =
      "<Relationship Target=\"/a.png\" Id=\"t\" Type=\"http://schemas.openxmlformats.org/package/"
      "2006/relationships/metadata/thumbnail\"/></Relationships>";
  const std::string model = model_of(
      tetrahedron_object(1, "thumbnail=\"/a.png\"") + tetrahedron_object(2, "thumbnail=\"/b.xml\""),
      item_of(1) + item_of(2));
  const std::string package =
      zip_of({{"_rels/.rels", replaced(kRelationships, "</Relationships>", link)},
              {"3D/3dmodel.model", model},
              {"a.png", "\x89PNG\r\n\x1A\n"},
              {"b.xml", "no picture"}});
  const std::string again = written(read_by_mesh(package, true));
  EXPECT_THAT(model_in(again), HasSubstr("thumbnail=\"/a.png\""));
  EXPECT_THAT(model_in(again), Not(HasSubstr("thumbnail=\"/b.xml\"")));
  EXPECT_EQ(read_by_peer(again, false).warnings, "");
  const MeshSource source{again, "a.3mf"};
  ZipReader archive(source);
  for (const char* links : {"_rels/.rels", "3D/_rels/3dmodel.model.rels"}) {
    EXPECT_THAT(archive.text_of(*archive.find(links)), HasSubstr("Target=\"/a.png\"")) << links;
  }
  EXPECT_EQ(written(read_by_mesh(again, true)), again);
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
