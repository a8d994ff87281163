// SPDX-License-Identifier: MIT
// Hidden nodes, skins and morph targets, from glTF to glTF.
#include <cstring>
#include <gmock/gmock.h>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <mesh/lost_attributes.h>
#include <mesh/skins.h>
#include <mesh/soup_io.h>

#include "gltf_maker.h"
#include "soup_fixtures.h"
#include "warning_texts.h"

namespace meshrepair {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

ReadResult read_moving(const std::string& bytes, bool by_mesh, bool attributes = true) {
  ReadOptions options;
  options.by_mesh = by_mesh;
  options.attributes = attributes;
  return read_soup(std::string_view(bytes), "a.glb", options);
}

std::string write_moving(const ReadResult& read, bool by_mesh) {
  SoupExtras extras;
  const Attributes held = held_by(SoupFormat::glb, read.attributes, by_mesh);
  extras.attributes = &held;
  if (by_mesh) extras.scene = &read.scene;
  return format_soup(read.soup, SoupFormat::glb, extras);
}

TestJson document_of(const std::string& glb) {
  std::uint32_t size = 0;
  std::memcpy(&size, glb.data() + 12, 4);
  return TestJson::parse(glb.substr(20, size));
}

// The node 0 is a joint, the node 1 a triangle with a skin, two morph targets and an animation of
// these.
GltfMaker dancer() {
  GltfMaker maker;
  const std::size_t positions = maker.add_accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  const std::size_t up = maker.add_accessor<float>({0, 0, 1, 0, 0, 2, 0, 0, 3}, "VEC3");
  const std::size_t joints =
      maker.add_accessor<std::uint8_t>({0, 1, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, "VEC4");
  const std::size_t weights =
      maker.add_accessor<float>({0.25f, 0.75f, 0, 0, 1, 0, 0, 0, 0.5f, 0.5f, 0, 0}, "VEC4");
  maker.add_root({{"name", "bone"}, {"children", {2}}});
  maker.add("nodes", {{"name", "body"}, {"mesh", 0}, {"skin", 0}, {"translation", {9, 9, 9}}});
  maker.root["scenes"][0]["nodes"].push_back(1);
  maker.add("nodes", {{"name", "hand"}});
  maker.add(
      "meshes",
      {{"name", "body"},
       {"weights", {0.5, 0}},
       {"extras", {{"targetNames", {"up", "turn"}}}},
       {"primitives",
        {{{"attributes", {{"POSITION", positions}, {"JOINTS_0", joints}, {"WEIGHTS_0", weights}}},
          {"targets", {{{"POSITION", up}}, {{"POSITION", up}, {"NORMAL", up}}}}}}}});
  const std::size_t matrices = maker.add_accessor<float>(std::vector<float>(32, 1), "VEC4");
  maker.root["accessors"][matrices]["type"] = "MAT4";
  maker.root["accessors"][matrices]["count"] = 2;
  maker.add("skins", {{"joints", {0, 2}}, {"inverseBindMatrices", matrices}, {"skeleton", 0}});
  const std::size_t times = maker.add_accessor<float>({0, 1}, "SCALAR");
  const std::size_t moves = maker.add_accessor<float>({0, 0, 1, 1}, "SCALAR");
  maker.add("animations",
            {{"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "weights"}}}}}},
             {"samplers", {{{"input", times}, {"output", moves}}}}});
  return maker;
}

void expect_same_values(const ReadResult& made, const ReadResult& given) {
  ASSERT_EQ(made.attributes.corners.size(), given.attributes.corners.size());
  for (std::size_t a = 0; a < given.attributes.corners.size(); ++a) {
    const CornerAttribute &x = made.attributes.corners[a], &y = given.attributes.corners[a];
    EXPECT_EQ(x.kind, y.kind);
    EXPECT_EQ(x.name, y.name);
    ASSERT_EQ(x.components, y.components);
    for (std::size_t c = 0; c < y.of_corner.size(); ++c) {
      for (std::size_t i = 0; i < y.components; ++i) {
        EXPECT_EQ(x.values[x.components * x.of_corner[c] + i],
                  y.values[y.components * y.of_corner[c] + i])
            << x.name << " " << c << " " << i;
      }
    }
  }
}

TEST(GltfMovement, SkinsAndTargetsComeBackInAScene) {
  const ReadResult read = read_moving(dancer().glb(), true);
  EXPECT_THAT(texts(read.report.warnings), IsEmpty());
  ASSERT_EQ(read.attributes.corners.size(), 4u);
  EXPECT_EQ(read.attributes.corners[3].kind, CornerAttribute::Kind::skin);
  const std::string glb = write_moving(read, true);
  expect_same_values(read_moving(glb, true), read);
  const TestJson root = document_of(glb);
  EXPECT_EQ(root["nodes"], dancer().root["nodes"]);
  EXPECT_EQ(root["skins"][0]["joints"], TestJson({0, 2}));
  const TestJson& matrices =
      root["accessors"][root["skins"][0]["inverseBindMatrices"].get<std::size_t>()];
  EXPECT_EQ(matrices["type"], "MAT4");
  const TestJson& mesh = root["meshes"][0];
  EXPECT_EQ(mesh["weights"], TestJson({0.5, 0}));
  EXPECT_EQ(mesh["primitives"][0]["targets"].size(), 2u);
  EXPECT_TRUE(mesh["primitives"][0]["targets"][1].contains("NORMAL"));
  EXPECT_EQ(root["animations"][0]["channels"].size(), 1u);
  const TestJson& joints =
      root["accessors"][mesh["primitives"][0]["attributes"]["JOINTS_0"].get<std::size_t>()];
  EXPECT_EQ(joints["componentType"], 5121);
}

TEST(GltfMovement, SkinsAndTargetsComeBackJoined) {
  const ReadResult read = read_moving(dancer().glb(), false);
  EXPECT_THAT(texts(read.report.warnings), ElementsAre(HasSubstr("1 channel of animations")));
  const std::string glb = write_moving(read, false);
  expect_same_values(read_moving(glb, false), read);
  const TestJson root = document_of(glb);
  EXPECT_EQ(root["nodes"][3], TestJson({{"mesh", 0}, {"name", "body"}, {"skin", 0}}));
  EXPECT_FALSE(root["nodes"][1].contains("skin"));
  EXPECT_EQ(root["meshes"][0]["weights"], TestJson({0.5, 0}));
  EXPECT_EQ(root["meshes"][0]["extras"]["targetNames"], TestJson({"up", "turn"}));
  EXPECT_FALSE(root.contains("animations"));
}

TEST(GltfMovement, NeighboursWithoutASkinHaveNone) {
  GltfMaker maker = dancer();
  TestJson rigid = maker.root["meshes"][0];
  rigid["primitives"][0] = {{"attributes", {{"POSITION", 0}}}};
  maker.add("meshes", rigid);
  maker.add_root({{"mesh", 1}, {"name", "rock"}});
  const TestJson root = document_of(write_moving(read_moving(maker.glb(), false), false));
  ASSERT_EQ(root["nodes"].size(), 6u);
  EXPECT_EQ(root["nodes"][4]["skin"], 0);
  EXPECT_FALSE(root["nodes"][5].contains("skin"));
  EXPECT_FALSE(root["meshes"][1].contains("weights"));
  EXPECT_FALSE(root["meshes"][1]["primitives"][0]["attributes"].contains("JOINTS_0"));
}

TEST(GltfMovement, PartsOfOneNameWithSeveralSkinsHaveNone) {
  GltfMaker maker = dancer();
  maker.add("skins", {{"joints", {2}}});
  maker.add_root({{"mesh", 0}, {"name", "body"}, {"skin", 1}});
  const ReadResult read = read_moving(maker.glb(), false);
  EXPECT_THAT(texts(read.report.warnings),
              ::testing::Contains(HasSubstr("1 object without a skin")));
  const TestJson root = document_of(write_moving(read, false));
  EXPECT_FALSE(root["nodes"].back().contains("skin"));
}

// Joints moved it, its node did not.
TEST(GltfMovement, MeshWithoutItsWeightsStandsWhereItStood) {
  ReadResult read = read_moving(dancer().glb(), true);
  read.attributes.corners.clear();
  const std::string glb = write_moving(read, true);
  const TestJson root = document_of(glb);
  EXPECT_EQ(root["nodes"][1], TestJson({{"name", "body"}, {"translation", {9, 9, 9}}}));
  EXPECT_EQ(root["nodes"][3], TestJson({{"mesh", 0}, {"name", "body"}}));
  EXPECT_FALSE(root.contains("animations"));
  EXPECT_FALSE(root["meshes"][0].contains("weights"));
  EXPECT_EQ(read_moving(glb, false).soup.points, read_moving(dancer().glb(), false).soup.points);
}

TEST(GltfMovement, OtherFormatsSayWhatTheyLose) {
  const ReadResult read = read_moving(dancer().glb(), false);
  const auto lost = lost_attributes(read.soup, read.attributes,
                                    held_by(SoupFormat::obj, read.attributes), SoupFormat::obj);
  EXPECT_THAT(lost, ElementsAre("morph targets", "weights of joints"));
}

TEST(GltfMovement, TargetsThatAreBrokenAreLeftOut) {
  const auto warnings_with = [](const TestJson& targets) {
    GltfMaker maker = dancer();
    maker.root["meshes"][0]["primitives"][0]["targets"] = targets;
    const ReadResult read = read_moving(maker.glb(), true);
    (void)read_moving(write_moving(read, true), true);
    return texts(read.report.warnings);
  };
  const auto without = ElementsAre(HasSubstr("read without morph targets"));
  EXPECT_THAT(warnings_with({{{"POSITION", 99}}}), without);
  EXPECT_THAT(warnings_with({{{"POSITION", 5}}}), without);
  EXPECT_THAT(warnings_with({{{"POSITION", "x"}}}), without);
  EXPECT_THAT(warnings_with(7), without);
  EXPECT_THAT(warnings_with({1, TestJson::object(), {{"POSITION", 1}}}), IsEmpty());
  EXPECT_THAT(warnings_with({{{"POSITION", 2}, {"_X", 1}}}), IsEmpty());
}

TEST(GltfMovement, TargetsTakeNoMoreRoomThanTheirBytes) {
  GltfMaker maker = dancer();
  const std::size_t triangles = 20000;
  std::vector<std::uint32_t> indices(3 * triangles);
  for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = static_cast<std::uint32_t>(i % 3);
  TestJson& primitive = maker.root["meshes"][0]["primitives"][0];
  primitive["indices"] = maker.add_accessor(indices, "SCALAR");
  primitive["targets"] = TestJson::array();
  for (int i = 0; i < 2000; ++i) primitive["targets"].push_back({{"POSITION", 1}});
  for (const bool by_mesh : {false, true}) {
    const ReadResult read = read_moving(maker.glb(), by_mesh);
    EXPECT_EQ(read.attributes.corners.size(), 1u);
    EXPECT_THAT(texts(read.report.warnings),
                ::testing::Contains(HasSubstr("read without morph targets")));
  }
}

TEST(GltfMovement, OddJointsHaveNoWeight) {
  GltfMaker maker = dancer();
  TestJson& attributes = maker.root["meshes"][0]["primitives"][0]["attributes"];
  attributes["JOINTS_0"] =
      maker.add_accessor<float>({-1, 0.5f, 70000, NAN, 0, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
  attributes["JOINTS_1"] = attributes["JOINTS_0"];
  const ReadResult read = read_moving(maker.glb(), true);
  const CornerAttribute& skin = read.attributes.corners.back();
  ASSERT_EQ(skin.components, kSkinSet);
  EXPECT_THAT(std::vector<double>(skin.values.begin(), skin.values.begin() + 8),
              ::testing::Each(0.0));
}

GltfMaker with_hidden_nodes() {
  GltfMaker maker = one_triangle();
  const auto hidden = [](bool visible) {
    return TestJson{{"KHR_node_visibility", {{"visible", visible}}}};
  };
  maker.root["extensionsUsed"] = {"KHR_node_visibility"};
  maker.add("nodes", {{"mesh", 0}, {"name", "below"}, {"extensions", hidden(true)}});
  maker.add_root({{"name", "above"}, {"children", {1}}, {"extensions", hidden(false)}});
  maker.add_root({{"mesh", 0}, {"name", "alone"}, {"extensions", hidden(false)}});
  maker.add_root({{"mesh", 0}, {"extensions", hidden(true)}, {"translation", {5, 0, 0}}});
  return maker;
}

TEST(GltfMovement, HiddenNodesAreNotJoined) {
  const ReadResult read = read_moving(with_hidden_nodes().glb(), false);
  EXPECT_EQ(read.soup.triangles.size(), 2u);
  EXPECT_THAT(texts(read.report.warnings),
              ElementsAre("2 nodes with meshes left out: hidden (--scene each keeps them): below, "
                          "alone"));
}

TEST(GltfMovement, HiddenNodesStayHiddenInAScene) {
  const ReadResult read = read_moving(with_hidden_nodes().glb(), true);
  EXPECT_THAT(texts(read.report.warnings), IsEmpty());
  EXPECT_EQ(read.scene.instances.size(), 4u);
  const TestJson root = document_of(write_moving(read, true));
  EXPECT_EQ(root["nodes"], with_hidden_nodes().root["nodes"]);
  EXPECT_EQ(root["extensionsUsed"], TestJson({"KHR_node_visibility"}));
  const auto lost = lost_attributes(read.soup, read.attributes, {}, SoupFormat::threemf);
  EXPECT_THAT(lost, ::testing::Contains("that nodes are hidden"));
}

TEST(GltfMovement, SceneOfHiddenNodesHoldsNothing) {
  GltfMaker maker = one_triangle();
  maker.root["nodes"][0]["extensions"] = {{"KHR_node_visibility", {{"visible", false}}}};
  EXPECT_THAT(refusal_of(maker.glb(), "a.glb"),
              HasSubstr("holds no triangles (1 node with meshes left out: hidden"));
}

// All targets below one would be written.
TEST(GltfMovement, AttributesAreNoMorphTargetsWhateverTheyAreCalled) {
  GltfMaker maker;
  const std::size_t points = maker.add_accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  maker.add_mesh(points)["attributes"]["TARGET_20000000/POSITION"] = points;
  const ReadResult read = read_moving(maker.glb(), false);
  EXPECT_THAT(read.attributes.corners, IsEmpty());
  EXPECT_LT(write_moving(read, false).size(), 2000U);
  CornerAttribute far;
  far.kind = CornerAttribute::Kind::other;
  far.components = 3;
  far.name = "TARGET_4095/POSITION";
  EXPECT_TRUE(morph_target_of(far));
  far.name = "TARGET_4096/POSITION";
  EXPECT_FALSE(morph_target_of(far));
}

}  // namespace
}  // namespace meshrepair
