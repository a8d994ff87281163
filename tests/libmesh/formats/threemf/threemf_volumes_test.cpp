// SPDX-License-Identifier: MIT
// Volumes of slicers' projects: which are the model, and what their projects say of them.
#include <gmock/gmock.h>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <base/error.h>
#include <mesh/lost_attributes.h>
#include <mesh/soup_io.h>

#include "formats/common/zip_reader.h"
#include "package_bytes.h"
#include "warning_texts.h"

namespace meshrepair {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

const std::string kPrusa = "Metadata/Slic3r_PE_model.config";
const std::string kOrca = "Metadata/model_settings.config";

ReadResult read_project(const std::string& package, const ReadOptions& options = {}) {
  return read_soup(std::string_view(package), "a.3mf", options);
}

ReadResult read_negative(const std::string& package, NegativeVolumes negative) {
  ReadOptions options;
  options.negative = negative;
  return read_project(package, options);
}

ReadResult read_each(const std::string& package) {
  ReadOptions options;
  options.by_mesh = true;
  options.attributes = true;
  return read_project(package, options);
}

std::string project_again(const ReadResult& result) {
  SoupExtras extras;
  extras.attributes = &result.attributes;
  extras.scene = &result.scene;
  return format_soup(result.soup, SoupFormat::threemf, extras);
}

std::string text_in(const std::string& package, const std::string& name) {
  const MeshSource source{package, "a.3mf"};
  ZipReader archive(source);
  const ZipReader::Entry* const entry = archive.find(name);
  return entry == nullptr ? std::string() : archive.text_of(*entry);
}

std::vector<std::string> roles_of(const ReadResult& result) {
  std::vector<std::string> roles;
  for (const ModelVolume& volume : result.report.volumes) {
    roles.push_back(std::string(role_name(volume.role)) + " " + volume.name + ": " +
                    std::string(fate_name(volume.fate)));
  }
  return roles;
}

// A mesh of `count` tetrahedra, one after the other, with points of their own.
std::string tetrahedra_object(int id, int count, const std::string& more = {}) {
  std::string vertices, triangles;
  for (int i = 0; i < count; ++i) {
    const std::string x = std::to_string(10 * i), x1 = std::to_string(10 * i + 1);
    vertices += "<vertex x=\"" + x + "\" y=\"0\" z=\"0\"/><vertex x=\"" + x1 +
                "\" y=\"0\" z=\"0\"/><vertex x=\"" + x + "\" y=\"1\" z=\"0\"/><vertex x=\"" + x +
                "\" y=\"0\" z=\"1\"/>";
    for (const auto& [a, b, c] : {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}) {
      triangles += "<triangle v1=\"" + std::to_string(4 * i + a) + "\" v2=\"" +
                   std::to_string(4 * i + b) + "\" v3=\"" + std::to_string(4 * i + c) + "\"/>";
    }
  }
  return "<object id=\"" + std::to_string(id) + "\"><mesh><vertices>" + vertices +
         "</vertices><triangles>" + more + triangles + "</triangles></mesh></object>";
}

std::string volume_of(int first, int last, const std::string& name, const std::string& type) {
  return "<volume firstid=\"" + std::to_string(first) + "\" lastid=\"" + std::to_string(last) +
         "\"><metadata type=\"volume\" key=\"name\" value=\"" + name + "\"/>" + type + "</volume>";
}

std::string type_of(const std::string& type) {
  return "<metadata type=\"volume\" key=\"volume_type\" value=\"" + type + "\"/>";
}

std::string config_of(int id, const std::string& inside) {
  return "<config>\n <object id=\"" + std::to_string(id) +
         "\" instances_count=\"1\"><metadata type=\"object\" key=\"name\" value=\"lid\"/>" +
         inside + "</object>\n</config>";
}

std::string prusa_package(const std::string& more = {}) {
  const std::string config =
      config_of(7, volume_of(0, 3, "body", type_of("ModelPart")) +
                       volume_of(4, 7, "cut", type_of("NegativeVolume")) +
                       volume_of(8, 11, "dense", type_of("ParameterModifier")) +
                       volume_of(12, 15, "old", "<metadata key=\"modifier\" value=\"1\"/>") +
                       volume_of(16, 19, "block", type_of("SupportBlocker")) +
                       volume_of(20, 23, "here", type_of("SupportEnforcer")));
  return package_of(model_of(tetrahedra_object(7, 6, more), item_of(7)), {{kPrusa, config}});
}

TEST(ThreemfVolumes, RangesOfTrianglesAreVolumes) {
  const ReadResult result = read_project(prusa_package());
  EXPECT_EQ(result.soup.triangles.size(), 4u);
  EXPECT_EQ(result.soup.points.size(), 4u);
  EXPECT_THAT(roles_of(result),
              ElementsAre("model body: joined", "negative volume cut: left_out",
                          "modifier dense: left_out", "modifier old: left_out",
                          "support blocker block: left_out", "support enforcer here: left_out"));
  EXPECT_EQ(result.report.volumes[0].object, "lid");
  EXPECT_THAT(
      texts(result.report.warnings),
      ElementsAre("negative volume 'cut' of the object 'lid' left out: it is not subtracted",
                  HasSubstr("modifier 'dense' of the object 'lid' left out"), HasSubstr("'old'"),
                  HasSubstr("'block'"), HasSubstr("'here'")));
}

TEST(ThreemfVolumes, NegativeOnesAreLeftOutOrKeptOrToldApart) {
  const std::string package = prusa_package();
  EXPECT_EQ(read_negative(package, NegativeVolumes::drop).soup.triangles.size(), 4u);
  const ReadResult kept = read_negative(package, NegativeVolumes::keep);
  EXPECT_EQ(kept.soup.triangles.size(), 8u);
  EXPECT_THAT(kept.placed, IsEmpty());
  const ReadResult apart = read_negative(package, NegativeVolumes::subtract);
  EXPECT_EQ(apart.soup.triangles.size(), 8u);
  ASSERT_EQ(apart.placed.size(), 2u);
  EXPECT_EQ(apart.placed[0].object, apart.placed[1].object);
  EXPECT_EQ(apart.placed[1].volume, 1u);
  EXPECT_EQ(apart.placed[1].first, 4u);
  EXPECT_EQ(apart.placed[1].triangles, 4u);
  EXPECT_EQ(apart.report.volumes[1].fate, VolumeFate::subtracted);
}

TEST(ThreemfVolumes, RangesAreOneMeshAgainWithTheirNewTriangles) {
  // Two triangles that are left out: ranges count them.
  const std::string bad = "<triangle v1=\"0\" v2=\"1\" v3=\"999\"/>";
  const ReadResult result = read_each(prusa_package(bad + bad));
  ASSERT_EQ(result.scene.meshes.size(), 7u);  // and what is in no volume
  EXPECT_EQ(result.scene.meshes[0].name, "body");
  EXPECT_EQ(result.scene.meshes[0].triangles, 2u);
  EXPECT_THAT(texts(result.report.warnings), ElementsAre(HasSubstr("2 triangles left out")));
  const std::string package = project_again(result);
  const std::string config = text_in(package, kPrusa);
  EXPECT_THAT(config, HasSubstr("<object id=\"7\" instances_count=\"1\">"));
  EXPECT_THAT(config, HasSubstr("<volume firstid=\"0\" lastid=\"1\"><metadata type=\"volume\" "
                                "key=\"name\" value=\"body\"/>"));
  EXPECT_THAT(config, HasSubstr("<volume firstid=\"2\" lastid=\"5\"><metadata type=\"volume\" "
                                "key=\"name\" value=\"cut\"/>"));
  const std::string model = text_in(package, "3D/3dmodel.model");
  EXPECT_THAT(model, HasSubstr("<object id=\"7\""));
  EXPECT_THAT(model, Not(HasSubstr("<components>")));
  EXPECT_EQ(read_project(package).soup.triangles.size(), 2u + 2u);  // the body, and the rest
  EXPECT_EQ(project_again(read_each(package)), package);
}

TEST(ThreemfVolumes, RangesKeepTheirSetsOfTriangles) {
  std::string object = tetrahedra_object(7, 2);
  object.insert(object.find("</mesh>"),
                "<t:trianglesets xmlns:t=\"http://schemas.microsoft.com/3dmanufacturing/"
                "trianglesets/2021/07\"><t:triangleset name=\"low\" identifier=\"a\"><t:refrange "
                "startindex=\"2\" endindex=\"4\"/></t:triangleset></t:trianglesets>");
  const std::string config = config_of(7, volume_of(0, 3, "body", type_of("ModelPart")) +
                                              volume_of(4, 7, "cut", type_of("NegativeVolume")));
  const ReadResult result = read_each(package_of(model_of(object, item_of(7)), {{kPrusa, config}}));
  EXPECT_THAT(result.attributes.groups.names, ElementsAre("low"));
  EXPECT_THAT(result.attributes.groups.of_triangle,
              ElementsAre(kNone, kNone, 0u, 0u, 0u, kNone, kNone, kNone));
  EXPECT_EQ(read_each(project_again(result)).attributes.groups.of_triangle,
            result.attributes.groups.of_triangle);
}

TEST(ThreemfVolumes, RangesThatAreNotThereOrOverlapAreModel) {
  const std::string cut = type_of("NegativeVolume");
  for (const std::string& volume :
       {volume_of(4, 99, "far", cut), volume_of(5, 4, "back", cut), volume_of(3, 7, "both", cut),
        std::string("<volume firstid=\"4\">") + cut + "</volume>"}) {
    const std::string config = config_of(1, volume_of(0, 3, "body", type_of("ModelPart")) + volume);
    const ReadResult result =
        read_project(package_of(model_of(tetrahedra_object(1, 2), item_of(1)), {{kPrusa, config}}));
    EXPECT_EQ(result.soup.triangles.size(), 8u) << volume;
    EXPECT_THAT(texts(result.report.warnings), ElementsAre(HasSubstr("1 volume taken for model")));
  }
}

std::string orca_package() {
  const std::string path = "p:path=\"/3D/Objects/object_1.model\" ";
  const std::string model = model_of(
      assembly_of(8, component_of(1, path) + component_of(2, path) + component_of(1, path)) +
          assembly_of(9, component_of(1, path)),
      item_of(8) + item_of(9), "requiredextensions=\"p\"");
  const std::string config =
      "<?xml version=\"1.0\"?>\n<config>\n<!-- kept --><object id=\"8\">"
      "<metadata key=\"name\" value=\"box\"/><metadata face_count=\"99\"/>"
      "<part id=\"1\" subtype=\"normal_part\"><metadata key=\"name\" value=\"body\"/>"
      "<mesh_stat face_count=\"98\"/></part>"
      "<part subtype='negative_part' id='2'><slic3rpe:text text=\"x\"/></part>"
      "<part id=\"1\" subtype=\"support_blocker\"/></object>"
      "<object id=\"77\"><metadata key=\"name\" value=\"gone\"/></object>"
      "<plate><metadata key=\"gcode_file\" value=\"Metadata/plate_1.gcode\"/>"
      "<model_instance><metadata key=\"object_id\" value=\"8\"/></model_instance>"
      "<model_instance><metadata key=\"object_id\" value=\"77\"/></model_instance></plate>"
      "<assemble><assemble_item object_id=\"9\" instance_id=\"0\"/></assemble></config>\n";
  return package_of(model, {{"3D/Objects/object_1.model",
                             model_of(tetrahedron_object(1) + tetrahedra_object(2, 2))},
                            {kOrca, config},
                            {"Metadata/plate_1.gcode", "G1\n"}});
}

TEST(ThreemfVolumes, ComponentsAreVolumesAndMayBeSeveral) {
  const ReadResult result = read_negative(orca_package(), NegativeVolumes::subtract);
  EXPECT_THAT(roles_of(result),
              ElementsAre("model body: joined", "negative volume : subtracted",
                          "support blocker : left_out", "model object 1: joined"));
  EXPECT_EQ(result.soup.triangles.size(), 4u + 8u + 4u);
  ASSERT_EQ(result.placed.size(), 3u);
  EXPECT_EQ(result.placed[0].object, result.placed[1].object);
  EXPECT_NE(result.placed[0].object, result.placed[2].object);
}

TEST(ThreemfVolumes, ProjectsFollowIdsAndLoseWhatIsGone) {
  const ReadResult result = read_each(orca_package());
  EXPECT_THAT(texts(result.report.warnings),
              ElementsAre(HasSubstr("the object gone, which is not there"),
                          HasSubstr("plate_1.gcode will not be written again: it belongs to")));
  EXPECT_EQ(text_in(project_again(result), kOrca),
            "<?xml version=\"1.0\"?>\n<config>\n<!-- kept --><object id=\"8\">"
            "<metadata key=\"name\" value=\"box\"/><metadata face_count=\"16\"/>"
            "<part id=\"1\" subtype=\"normal_part\"><metadata key=\"name\" value=\"body\"/>"
            "<mesh_stat face_count=\"4\"/></part>"
            "<part subtype='negative_part' id='2'><slic3rpe:text text=\"x\"/></part>"
            "<part id=\"1\" subtype=\"support_blocker\"/></object>"
            "<plate><metadata key=\"gcode_file\" value=\"\"/>"
            "<model_instance><metadata key=\"object_id\" value=\"8\"/></model_instance></plate>"
            "<assemble><assemble_item object_id=\"9\" instance_id=\"0\"/></assemble></config>\n");
  EXPECT_EQ(project_again(read_each(project_again(result))), project_again(result));
}

TEST(ThreemfVolumes, ObjectsOfOneIdInTwoPartsGetNewOnesInTheirProjects) {
  const auto path = [](const std::string& part) { return "p:path=\"/3D/" + part + ".model\""; };
  const std::string model =
      model_of(assembly_of(5, component_of(1, path("b")) + component_of(1, path("c"))), item_of(5));
  const std::string config =
      "<config><object id=\"5\"><part id=\"1\" subtype=\"normal_part\"/>"
      "<part id=\"1\" subtype=\"modifier_part\"/></object></config>";
  const ReadResult result =
      read_each(package_of(model, {{"3D/b.model", model_of(tetrahedron_object(1))},
                                   {"3D/c.model", model_of(tetrahedra_object(1, 2))},
                                   {kOrca, config}}));
  const std::string package = project_again(result);
  EXPECT_EQ(text_in(package, kOrca),
            "<config><object id=\"5\"><part id=\"1\" subtype=\"normal_part\"/>"
            "<part id=\"6\" subtype=\"modifier_part\"/></object></config>");
  EXPECT_THAT(text_in(package, "3D/3dmodel.model"),
              HasSubstr("<component objectid=\"1\"/>\n<component objectid=\"6\"/>"));
  EXPECT_THAT(roles_of(read_project(package)),
              ElementsAre("model object 1: joined", "modifier object 6: left_out"));
}

TEST(ThreemfVolumes, SettingsOfCuraSayWhatAMeshIs) {
  const auto cura = [](int id, const std::string& key, const std::string& value) {
    std::string object = tetrahedron_object(id, "name=\"" + key + "\"");
    return object.insert(object.find("<mesh>"), "<metadatagroup><metadata name=\"cura:" + key +
                                                    "\" preserve=\"true\">" + value +
                                                    "</metadata></metadatagroup>");
  };
  std::string model =
      model_of(cura(1, "drop_to_buildplate", "True") + cura(2, "support_mesh", "True") +
                   cura(3, "anti_overhang_mesh", "True") + cura(4, "infill_mesh", "True") +
                   cura(5, "cutting_mesh", "true") + cura(6, "infill_mesh", "False"),
               item_of(1) + item_of(2) + item_of(3) + item_of(4) + item_of(5) + item_of(6));
  const std::string space = "xmlns:cura=\"http://software.ultimaker.com/xml/cura/3mf/2015/10\" ";
  model.insert(model.find("<model ") + 7, space);
  const ReadResult result = read_project(package_of(model));
  EXPECT_EQ(result.soup.triangles.size(), 8u);
  EXPECT_THAT(
      roles_of(result),
      ElementsAre("model drop_to_buildplate: joined", "support support_mesh: left_out",
                  "support blocker anti_overhang_mesh: left_out", "modifier infill_mesh: left_out",
                  "modifier cutting_mesh: left_out", "model infill_mesh: joined"));
}

TEST(ThreemfVolumes, ItemsThatAreNotPrintedAreLeftOutUnlessAllAre) {
  const std::string objects = tetrahedron_object(1) + tetrahedra_object(2, 2);
  const ReadResult some =
      read_project(package_of(model_of(objects, item_of(1) + item_of(2, "printable=\"0\""))));
  EXPECT_EQ(some.soup.triangles.size(), 4u);
  EXPECT_THAT(texts(some.report.warnings),
              ElementsAre("volume 'object 2' left out: it is not to be printed"));
  const ReadResult all = read_project(
      package_of(model_of(objects, item_of(1, "printable=\"0\"") + item_of(2, "printable=\"0\""))));
  EXPECT_EQ(all.soup.triangles.size(), 12u);
  EXPECT_THAT(texts(all.report.warnings),
              ElementsAre(HasSubstr("none of its items is to be printed")));
}

TEST(ThreemfVolumes, AProjectWithoutAModelSaysWhy) {
  const std::string package =
      package_of(model_of(tetrahedron_object(1, "type=\"support\""), item_of(1)));
  try {
    (void)read_project(package);
    FAIL() << "no exception";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("holds nothing of a model: support 'object 1' left out"));
  }
}

TEST(ThreemfVolumes, ProjectsThatCannotBeReadAreTold) {
  for (const std::string& config :
       {std::string("<config><object id="), std::string("<!DOCTYPE a><config/>"), std::string()}) {
    const std::string package =
        package_of(model_of(tetrahedron_object(1), item_of(1)), {{kOrca, config}});
    const ReadResult result = read_each(package);
    EXPECT_EQ(result.soup.triangles.size(), 4u);
    EXPECT_THAT(texts(result.report.warnings), ElementsAre(HasSubstr("cannot be read")));
    EXPECT_EQ(text_in(project_again(result), kOrca), "");
  }
}

TEST(ThreemfVolumes, FormatsWithoutProjectsSayWhatIsLost) {
  const ReadResult result = read_each(orca_package());
  EXPECT_THAT(result.attributes.keepsake->lost_in(SoupFormat::glb),
              ElementsAre("what slicers say of objects and volumes"));
}

// Of the four triangles the first two are painted.
std::string painted_package(const std::string& settings_name, const std::string& settings) {
  std::string object = tetrahedron_object(1);
  object.insert(object.find("/>", object.find("<triangle ")), " paint_color=\"0C\"");
  object.insert(object.find("/>", object.find("<triangle v1=\"0\" v2=\"1\"")),
                " paint_color=\"841\" paint_seam=\"4\"");
  const std::string mirror = "transform=\"-1 0 0 0 1 0 0 0 1 9 0 0\"";
  return package_of(model_of(object, item_of(1) + item_of(1, mirror)), {{settings_name, settings}});
}

TEST(ThreemfPaint, StaysAndIsTurnedInAMirror) {
  ReadOptions options;
  options.attributes = true;
  const ReadResult result =
      read_project(painted_package("Metadata/project_settings.config", "{}"), options);
  ASSERT_EQ(result.attributes.paints.size(), 2u);
  const TriangleLabels& codes = result.attributes.paints[0].codes;
  const auto code = [&](std::size_t t) {
    return codes.of_triangle[t] == kNone ? std::string() : codes.names[codes.of_triangle[t]];
  };
  EXPECT_EQ(code(0), "0C");
  EXPECT_EQ(code(1), "841");
  EXPECT_EQ(code(2), "");
  EXPECT_EQ(code(4), "0C");
  EXPECT_EQ(result.attributes.paints[1].name, "paint_seam");
  const std::string again =
      format_soup(result.soup, SoupFormat::threemf, {.attributes = &result.attributes});
  EXPECT_THAT(text_in(again, "3D/3dmodel.model"),
              HasSubstr(" paint_color=\"841\" paint_seam=\"4\"/>"));
}

TEST(ThreemfPaint, FilamentsAreMaterialsElsewhere) {
  ReadOptions options;
  options.attributes = true;
  for (const auto& [name, settings] :
       {std::pair("Metadata/project_settings.config",
                  "{\"a\": 1, \"filament_colour\": [\"#FF0000\", \"#00FF00\",\n \"#0000FF\"]}"),
        std::pair("Metadata/Slic3r_PE.config",
                  "; first line\n; extruder_colour = \"\";\"\";#0000FF\n; filament_colour = "
                  "#FF0000;#00FF00;#000000\n")}) {
    const ReadResult result = read_project(painted_package(name, settings), options);
    const Attributes held = held_by(SoupFormat::obj, result.attributes);
    EXPECT_THAT(held.materials.names, ElementsAre("filament 1", "filament 3"));
    EXPECT_EQ(held.looks[0].colour, (std::array<double, 4>{1, 0, 0, 1}));
    EXPECT_EQ(held.looks[1].colour, (std::array<double, 4>{0, 0, 1, 1}));
    EXPECT_EQ(held.materials.of_triangle[0], 1u);
    EXPECT_EQ(held.materials.of_triangle[1], 0u);
    EXPECT_EQ(held.materials.of_triangle[2], kNone);
    EXPECT_THAT(lost_attributes(result.soup, result.attributes, held, SoupFormat::obj),
                ElementsAre("'paint_color' of parts of triangles", "'paint_seam'",
                            "other parts of the package"));
  }
}

}  // namespace
}  // namespace meshrepair
