// SPDX-License-Identifier: MIT
// Which objects of a package become the soup, and where they are put.
#include <gmock/gmock.h>
#include <string>

#include <gtest/gtest.h>

#include <mesh/soup_io.h>

#include "package_bytes.h"
#include "soup_fixtures.h"
#include "warning_texts.h"

namespace meshrepair {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

ReadResult read_bytes(const std::string& bytes, bool attributes = false) {
  ReadOptions options;
  options.attributes = attributes;
  return read_soup(std::string_view(bytes), "a.3mf", options);
}

TriangleSoup soup_of(const std::string& resources, const std::string& items) {
  return read_bytes(package_of(model_of(resources, items))).soup;
}

TEST(ReadThreemf, ReadsAnObjectWithoutTransform) {
  const ReadResult result = read_bytes(package_of(model_of(tetrahedron_object(1), item_of(1))));
  EXPECT_EQ(result.soup.points, tetrahedron().points);
  EXPECT_EQ(result.soup.triangles, tetrahedron().triangles);
  EXPECT_EQ(result.report.format, SoupFormat::threemf);
  EXPECT_THAT(texts(result.report.warnings), ElementsAre());
}

TEST(ReadThreemf, ItemsArePutWhereTheirTransformsSay) {
  const TriangleSoup soup = soup_of(
      tetrahedron_object(1), item_of(1) + item_of(1, "transform=\"0 1 0 -1 0 0 0 0 1 10 20 30\""));
  ASSERT_EQ(soup.triangles.size(), 8u);
  EXPECT_EQ(soup.points[4], Vec3d(10, 20, 30));
  EXPECT_EQ(soup.points[5], Vec3d(10, 21, 30));  // x becomes y
  EXPECT_EQ(soup.points[6], Vec3d(9, 20, 30));   // y becomes -x
  EXPECT_EQ(soup.points[7], Vec3d(10, 20, 31));
  EXPECT_EQ(soup.triangles[4], (Triangle{4, 6, 5}));
}

TEST(ReadThreemf, MirroredObjectsAreTurned) {
  const TriangleSoup soup =
      soup_of(tetrahedron_object(1), item_of(1, "transform=\"-1 0 0 0 1 0 0 0 1 0 0 0\""));
  EXPECT_EQ(soup.points[1], Vec3d(-1, 0, 0));
  EXPECT_EQ(soup.triangles[0], (Triangle{0, 1, 2}));
}

TEST(ReadThreemf, ComponentsAreMovedBeforeWhatTheyArePartOf) {
  // By 1 along x in the inner one, twice as large in the middle, by 100 along y in the item.
  const std::string move = "transform=\"1 0 0 0 1 0 0 0 1 1 0 0\"";
  const std::string scale = "transform=\"2 0 0 0 2 0 0 0 2 0 0 0\"";
  const std::string lift = "transform=\"1 0 0 0 1 0 0 0 1 0 100 0\"";
  const TriangleSoup soup =
      soup_of(tetrahedron_object(1) + assembly_of(2, component_of(1, move) + component_of(1)) +
                  assembly_of(3, component_of(2, scale)),
              item_of(3, lift));
  ASSERT_EQ(soup.points.size(), 8u);
  EXPECT_EQ(soup.points[0], Vec3d(2, 100, 0));
  EXPECT_EQ(soup.points[1], Vec3d(4, 100, 0));
  EXPECT_EQ(soup.points[4], Vec3d(0, 100, 0));
  EXPECT_EQ(soup.points[7], Vec3d(0, 100, 2));
}

TEST(ReadThreemf, TwoMirrorsTurnNothing) {
  const std::string mirror = "transform=\"-1 0 0 0 1 0 0 0 1 0 0 0\"";
  const TriangleSoup soup =
      soup_of(tetrahedron_object(1) + assembly_of(2, component_of(1, mirror)), item_of(2, mirror));
  EXPECT_EQ(soup.triangles, tetrahedron().triangles);
  EXPECT_EQ(soup.points, tetrahedron().points);
}

TEST(ReadThreemf, FileWithoutItemsGivesAllObjectsThatAreNoComponents) {
  const TriangleSoup soup =
      soup_of(tetrahedron_object(1) + tetrahedron_object(2) + assembly_of(3, component_of(1)), "");
  EXPECT_EQ(soup.triangles.size(), 8u);
}

TEST(ReadThreemf, WhatTheBuildDoesNotNameIsLeftOut) {
  const ReadResult result =
      read_bytes(package_of(model_of(tetrahedron_object(1) + tetrahedron_object(2), item_of(2))));
  EXPECT_EQ(result.soup.triangles.size(), 4u);
  EXPECT_THAT(texts(result.report.warnings), ElementsAre());
}

TEST(ReadThreemf, SupportsAndOtherObjectsAreLeftOutWithAWarning) {
  const ReadResult result = read_bytes(
      package_of(model_of(tetrahedron_object(1) + tetrahedron_object(2, "type=\"other\"") +
                              tetrahedron_object(3, "type=\"support\"") +
                              tetrahedron_object(4, "type=\"solidsupport\"") +
                              assembly_of(5, component_of(1) + component_of(2)),
                          item_of(5) + item_of(3) + item_of(4))));
  EXPECT_EQ(result.soup.triangles.size(), 4u);
  EXPECT_THAT(texts(result.report.warnings),
              ElementsAre(HasSubstr("object that is not built 'object 2' left out"),
                          HasSubstr("support 'object 3' left out"),
                          HasSubstr("support 'object 4' left out")));
}

TEST(ReadThreemf, ObjectsInOtherPartsAreFound) {
  const std::string path = "p:path=\"/3D/Objects/object_1.model\"";
  const std::string model =
      model_of(assembly_of(2, component_of(1, path)), item_of(2), "requiredextensions=\"p\"");
  const std::string other = model_of(tetrahedron_object(1));
  const ReadResult result = read_bytes(package_of(model, {{"3D/Objects/object_1.model", other}}));
  EXPECT_EQ(result.soup.triangles, tetrahedron().triangles);
  EXPECT_THAT(texts(result.report.warnings), ElementsAre());
}

TEST(ReadThreemf, OtherPartsMayHaveOtherUnits) {
  const std::string path = "p:path=\"/3D/b.model\" transform=\"1 0 0 0 1 0 0 0 1 5 0 0\"";
  const std::string model = model_of("", item_of(1, path), "unit=\"centimeter\"");
  const std::string other = model_of(tetrahedron_object(1), "", "unit=\"meter\"");
  const ReadResult result = read_bytes(package_of(model, {{"3D/b.model", other}}));
  EXPECT_EQ(result.soup.points[0], Vec3d(5, 0, 0));
  EXPECT_EQ(result.soup.points[1], Vec3d(105, 0, 0));
}

TEST(ReadThreemf, PartsThatNameEachOtherAreReadOnce) {
  const auto path = [](const std::string& part) { return "p:path=\"/3D/" + part + ".model\""; };
  const std::string model = model_of("", item_of(1, path("b")));
  const std::string b =
      model_of(tetrahedron_object(2) + assembly_of(1, component_of(1, path("c"))));
  const std::string c = model_of(assembly_of(1, component_of(2, path("b"))));
  const ReadResult result = read_bytes(package_of(model, {{"3D/b.model", b}, {"3D/c.model", c}}));
  EXPECT_EQ(result.soup.triangles.size(), 4u);
}

TEST(ReadThreemf, NamesOfPartsMayBeWrittenInOtherWays) {
  const std::string model = model_of(tetrahedron_object(1), item_of(1));
  const std::string relationships =
      replaced(kRelationships, "/3D/3dmodel.model", "3D/./x/../My%20Model.MODEL");
  EXPECT_EQ(read_bytes(zip_of({{"_RELS/.rels", relationships}, {"3d\\my model.model", model}}))
                .soup.triangles.size(),
            4u);
}

TEST(ReadThreemf, NamesOfObjectsAreLabels) {
  const std::string resources = tetrahedron_object(1, "name=\"inner\"") + tetrahedron_object(2) +
                                "<object id=\"3\" name=\"all\"><components>" + component_of(1) +
                                component_of(2) + "</components></object>";
  const ReadResult result =
      read_bytes(package_of(model_of(resources, item_of(3) + item_of(2))), true);
  const TriangleLabels& objects = result.attributes.objects;
  EXPECT_THAT(objects.names, ElementsAre("inner", "all"));
  ASSERT_EQ(objects.of_triangle.size(), 12u);
  EXPECT_EQ(objects.of_triangle[0], 0u);
  EXPECT_EQ(objects.of_triangle[4], 1u);
  EXPECT_EQ(objects.of_triangle[8], kNone);
}

TEST(ReadThreemf, MirroredTrianglesTakeTheirPropertiesAlong) {
  const std::string resources =
      "<m:colorgroup id=\"9\"><m:color color=\"#000000\"/><m:color color=\"#FF0000\"/>"
      "<m:color color=\"#00FF00\"/></m:colorgroup>" +
      object_of(1, "<triangle v1=\"0\" v2=\"1\" v3=\"2\" pid=\"9\" p1=\"0\" p2=\"1\" p3=\"2\"/>");
  const ReadResult result = read_bytes(
      package_of(model_of(resources, item_of(1, "transform=\"-1 0 0 0 1 0 0 0 1 0 0 0\""))), true);
  ASSERT_EQ(result.attributes.corners.size(), 1u);
  EXPECT_EQ(result.soup.triangles[0], (Triangle{0, 2, 1}));
  EXPECT_THAT(result.attributes.corners[0].of_corner, ElementsAre(0u, 2u, 1u));
}

}  // namespace
}  // namespace meshrepair
