// SPDX-License-Identifier: MIT
// Meshes of a glTF file one by one, and the nodes that they come back to.
#include <cmath>
#include <cstring>
#include <gmock/gmock.h>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <mesh/soup_io.h>

#include "gltf_maker.h"
#include "soup_fixtures.h"
#include "warning_texts.h"

namespace meshrepair {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

ReadResult read_by_mesh(const std::string& bytes, bool attributes = true,
                        const std::string& name = "a.glb") {
  ReadOptions options;
  options.by_mesh = true;
  options.attributes = attributes;
  return read_soup(std::string_view(bytes), name, options);
}

TriangleSoup read_joined(const std::string& bytes, const std::string& name = "a.glb") {
  return read_soup(std::string_view(bytes), name).soup;
}

std::string write_scene(const ReadResult& read, SoupFormat format,
                        std::optional<LengthUnit> unit = std::nullopt) {
  SoupExtras extras;
  extras.attributes = &read.attributes;
  extras.scene = &read.scene;
  extras.unit = unit;
  return format_soup(read.soup, format, extras);
}

TestJson root_of(const std::string& glb) {
  std::uint32_t size = 0;
  std::memcpy(&size, glb.data() + 12, 4);
  return TestJson::parse(glb.substr(20, size));
}

std::size_t add_tetrahedron(GltfMaker& maker, float size, const std::string& name) {
  const std::size_t positions =
      maker.add_accessor<float>({0, 0, 0, size, 0, 0, 0, size, 0, 0, 0, size}, "VEC3");
  const std::size_t indices =
      maker.add_accessor<std::uint16_t>({0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}, "SCALAR");
  TestJson mesh = {
      {"primitives", {{{"attributes", {{"POSITION", positions}}}, {"indices", indices}}}},
      {"extras", {{"maker", name}}}};
  if (!name.empty()) mesh["name"] = name;
  return maker.add("meshes", mesh);
}

// Of the corners of all triangles: equal points may be one or several.
std::vector<Vec3d> places_of(const TriangleSoup& soup) {
  std::vector<Vec3d> places;
  for (const auto& t : soup.triangles) {
    for (const std::uint32_t p : t) places.push_back(soup.points[p]);
  }
  return places;
}

// A tree of nodes: one mesh in two places, one without triangles, one that no node has, a camera.
GltfMaker furnished() {
  GltfMaker maker;
  const std::size_t chair = add_tetrahedron(maker, 1, "chair");
  const std::size_t lines = maker.add(
      "meshes",
      {{"primitives",
        {{{"attributes", {{"POSITION", maker.add_accessor<float>({0, 0, 0, 1, 1, 1}, "VEC3")}}},
          {"mode", 1}}}}});
  const std::size_t table = add_tetrahedron(maker, 3, "table");
  add_tetrahedron(maker, 5, "spare");
  maker.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}});
  const std::size_t left = maker.add("nodes", {{"mesh", chair}, {"translation", {1, 2, 3}}});
  const std::size_t right = maker.add(
      "nodes", {{"mesh", chair}, {"name", "mirrored"}, {"scale", {-1, 1, 1}}, {"extras", 7}});
  maker.add_root({{"mesh", table},
                  {"rotation", {0, 0, std::sqrt(0.5), std::sqrt(0.5)}},
                  {"children", {left, right}}});
  maker.add_root({{"camera", 0}});
  maker.add_root({{"mesh", lines}});
  return maker;
}

TEST(GltfScene, MeshesAreInTheirOwnFramesAndNodesStay) {
  const std::string glb = furnished().glb();
  const ReadResult read = read_by_mesh(glb);
  ASSERT_EQ(read.scene.meshes.size(), 4u);
  EXPECT_EQ(read.scene.meshes[0].name, "chair");
  EXPECT_EQ(read.scene.meshes[1].triangles, 0u);
  EXPECT_EQ(read.scene.meshes[2].name, "table");
  EXPECT_EQ(read.scene.instances.size(), 4u);
  EXPECT_EQ(meshes_of(read.soup, read.scene)[0].points[2], Vec3d(1, 0, 0));
  ReadResult placed = read;
  place_instances(placed.soup, placed.attributes, placed.scene);
  EXPECT_EQ(places_of(placed.soup), places_of(read_joined(glb)));
  const std::string again = write_scene(read, SoupFormat::glb);
  const TestJson root = root_of(again);
  EXPECT_EQ(root["nodes"].size(), 5u);
  EXPECT_EQ(root["nodes"][1]["extras"], 7);
  EXPECT_EQ(root["nodes"][2]["children"], TestJson({0, 1}));
  EXPECT_EQ(root["nodes"][3]["camera"], 0);
  EXPECT_FALSE(root["nodes"][4].contains("mesh"));
  ASSERT_EQ(root["meshes"].size(), 3u);
  EXPECT_EQ(root["meshes"][1]["name"], "table");
  EXPECT_EQ(root["meshes"][2]["extras"]["maker"], "spare");
  EXPECT_EQ(read_joined(again).points, read_joined(glb).points);
  EXPECT_EQ(read_joined(again).triangles, read_joined(glb).triangles);
}

TEST(GltfScene, MeshesOfOtherScenesAreLeftOutWithAWarning) {
  GltfMaker maker = furnished();
  const std::size_t chosen = maker.add("scenes", {{"nodes", {maker.add("nodes", {{"mesh", 3}})}}});
  maker.root["scene"] = chosen;
  const ReadResult joined = read_soup(std::string_view(maker.glb()), "a.glb", {.attributes = true});
  EXPECT_EQ(joined.soup.points[2], Vec3d(5, 0, 0));
  EXPECT_EQ(joined.soup.triangles.size(), 4u);
  EXPECT_THAT(texts(joined.report.warnings),
              ::testing::Contains("4 nodes with meshes left out: not in the scene that is shown"));
  const TestJson root =
      root_of(format_soup(joined.soup, SoupFormat::glb, {.attributes = &joined.attributes}));
  EXPECT_EQ(root["scene"], chosen);
  EXPECT_EQ(root["scenes"][0], maker.root["scenes"][0]);
  EXPECT_EQ(root["meshes"].size(), 1u);
  const ReadResult each = read_by_mesh(maker.glb());
  EXPECT_THAT(texts(each.report.warnings), Not(::testing::Contains(HasSubstr("not in the scene"))));
  EXPECT_EQ(root_of(write_scene(each, SoupFormat::glb))["nodes"][0]["mesh"], 0);
}

TEST(GltfScene, GpuInstancesStay) {
  GltfMaker maker;
  const std::size_t mesh = add_tetrahedron(maker, 1, "tree");
  const std::size_t offsets = maker.add_accessor<float>({0, 0, 0, 5, 0, 0, 0, 7, 0}, "VEC3");
  maker.add_root({{"mesh", mesh},
                  {"extensions",
                   {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", offsets}}}}}}}});
  maker.root["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
  for (const bool attributes : {false, true}) {
    const ReadResult read = read_by_mesh(maker.glb(), attributes);
    EXPECT_EQ(read.soup.triangles.size(), 4u);
    EXPECT_EQ(read.scene.instances.size(), 3u);
    const std::string again = write_scene(read, SoupFormat::glb);
    EXPECT_EQ(read_joined(again).points, read_joined(maker.glb()).points);
    EXPECT_EQ(root_of(again)["extensionsUsed"], TestJson({"EXT_mesh_gpu_instancing"}));
  }
}

TEST(GltfScene, WithoutAttributesMaterialsGoButNodesStay) {
  GltfMaker maker = furnished();
  maker.add("images", {{"uri", "data:image/png;base64,iVBORw0KGgo="}});
  maker.add("textures", {{"source", 0}});
  maker.add("materials", {{"name", "oak"}});
  maker.root["meshes"][0]["primitives"][0]["material"] = 0;
  const std::string bare = write_scene(read_by_mesh(maker.glb(), false), SoupFormat::glb);
  EXPECT_THAT(root_of(bare).dump(), Not(HasSubstr("oak")));
  EXPECT_FALSE(root_of(bare).contains("images"));
  EXPECT_EQ(read_joined(bare).points, read_joined(maker.glb()).points);
  const std::string full = write_scene(read_by_mesh(maker.glb(), true), SoupFormat::glb);
  EXPECT_EQ(root_of(full)["materials"][0]["name"], "oak");
  EXPECT_TRUE(root_of(full).contains("images"));
}

TEST(GltfScene, MeshesWithSkinsStandWhereTheyStood) {
  GltfMaker maker;
  const std::size_t mesh = add_tetrahedron(maker, 1, "body");
  maker.add("nodes", {{"name", "joint"}});
  maker.add("skins", {{"joints", {0}}});
  maker.add_root({{"mesh", mesh}, {"skin", 0}, {"translation", {9, 9, 9}}});
  const std::string again = write_scene(read_by_mesh(maker.glb()), SoupFormat::glb);
  EXPECT_EQ(read_joined(again).points, read_joined(maker.glb()).points);
  const TestJson root = root_of(again);
  for (const TestJson& node : root["nodes"]) EXPECT_FALSE(node.contains("skin"));
}

// Any matrix, also one that no single node may have.
TEST(GltfScene, ComeBackFrom3mfWhereTheyWere) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> real(-2, 2);
  for (int i = 0; i < 100; ++i) {
    ReadResult scene = read_by_mesh(furnished().glb());
    for (SceneInstance& instance : scene.scene.instances) {
      Placement& placement = instance.placement;
      for (int k = 0; k < 9; ++k) placement.linear(k / 3, k % 3) = real(random);
      placement.offset = Vec3d(real(random), real(random), real(random));
      if (i % 3 == 0) placement.linear = Eigen::Matrix3d::Identity() * real(random);
    }
    scene.attributes.keepsake = nullptr;
    const std::string package = write_scene(scene, SoupFormat::threemf, LengthUnit::meter);
    const ReadResult first = read_by_mesh(package, true, "a.3mf");
    EXPECT_EQ(first.report.unit, LengthUnit::meter);
    const TriangleSoup expected = read_joined(package, "a.3mf");
    const TriangleSoup found = read_joined(write_scene(first, SoupFormat::glb));
    ASSERT_EQ(found.triangles.size(), expected.triangles.size());
    for (std::size_t t = 0; t < found.triangles.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3d& a = found.points[found.triangles[t][k]];
        const Vec3d& b = expected.points[expected.triangles[t][k]];
        EXPECT_LT((a - b).norm(), 1e-12) << i;
      }
    }
  }
}

TEST(GltfScene, OtherUnitsAreTheScaleOfANode) {
  SoupExtras extras;
  extras.unit = LengthUnit::inch;
  const std::string glb = format_soup(tetrahedron(), SoupFormat::glb, extras);
  EXPECT_EQ(root_of(glb)["nodes"][0]["scale"], TestJson({0.0254, 0.0254, 0.0254}));
  EXPECT_EQ(read_joined(glb).points[1], Vec3d(0, 0.0254, 0));
  ReadResult read = read_by_mesh(furnished().glb());
  read.attributes.keepsake = nullptr;
  const TestJson root = root_of(write_scene(read, SoupFormat::glb, LengthUnit::millimeter));
  const TestJson& above = root["nodes"][root["scenes"][0]["nodes"][0].get<std::size_t>()];
  EXPECT_EQ(above["scale"], TestJson({0.001, 0.001, 0.001}));
  EXPECT_EQ(above["children"].size(), 3u);
  extras.unit = LengthUnit::meter;
  EXPECT_FALSE(
      root_of(format_soup(tetrahedron(), SoupFormat::glb, extras))["nodes"][0].contains("scale"));
}

TEST(GltfScene, NodesThatNameNoMeshAreRefused) {
  GltfMaker maker = furnished();
  maker.add_root({{"mesh", 17}});
  EXPECT_THROW((void)read_by_mesh(maker.glb()), std::exception);
}

}  // namespace
}  // namespace meshrepair
