// SPDX-License-Identifier: MIT
// What glTF files can say, and what it means.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <meshoptimizer.h>
#include <string>

#include <gtest/gtest.h>

#include <mesh/soup_io.h>

#include "gltf_maker.h"
#include "soup_fixtures.h"
#include "temporary_folder.h"
#include "warning_texts.h"

namespace meshrepair {
namespace {

using Kind = CornerAttribute::Kind;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

ReadResult read_all(const std::string& bytes) {
  ReadOptions options;
  options.attributes = true;
  return read_soup(std::string_view(bytes), "a", options);
}

std::vector<double> coordinates(const TriangleSoup& soup) {
  std::vector<double> list;
  for (const Triangle& triangle : soup.triangles) {
    for (const std::uint32_t corner : triangle) {
      for (const double x : soup.points[corner]) list.push_back(x);
    }
  }
  return list;
}

// Values at the corners, one after the other.
std::vector<double> values_at_corners(const CornerAttribute& attribute) {
  std::vector<double> list;
  for (const std::uint32_t number : attribute.of_corner) {
    for (std::size_t k = 0; k < attribute.components; ++k) {
      list.push_back(attribute.values[attribute.components * number + k]);
    }
  }
  return list;
}

template <class Number>
std::vector<double> positions_of(const std::vector<Number>& numbers, bool normalized) {
  GltfMaker maker;
  maker.add_mesh(maker.add_accessor<Number>(numbers, "VEC3", normalized));
  return coordinates(read_text(maker.glb(), "a").soup);
}

TEST(GltfReader, AllTypesOfNumbersAreRead) {
  EXPECT_EQ(positions_of<std::int8_t>({0, 1, -2, 3, 4, 5, 6, 7, -128}, false),
            (std::vector<double>{0, 1, -2, 3, 4, 5, 6, 7, -128}));
  EXPECT_EQ(positions_of<std::uint8_t>({0, 1, 2, 3, 4, 5, 6, 7, 255}, false),
            (std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7, 255}));
  EXPECT_EQ(positions_of<std::int16_t>({0, 1, -2, 3, 4, 5, 6, 7, -32768}, false),
            (std::vector<double>{0, 1, -2, 3, 4, 5, 6, 7, -32768}));
  EXPECT_EQ(positions_of<std::uint16_t>({0, 1, 2, 3, 4, 5, 6, 7, 65535}, false),
            (std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7, 65535}));
  EXPECT_EQ(positions_of<float>({0, 1, 0.1f, 3, 4, 5, 6, 7, 1e30f}, false),
            (std::vector<double>{0, 1, 0.1f, 3, 4, 5, 6, 7, 1e30f}));
}

TEST(GltfReader, NormalizedIntegersAreShares) {
  EXPECT_EQ(positions_of<std::int8_t>({0, 127, -127, -128, 1, 0, 0, 0, 64}, true),
            (std::vector<double>{0, 1, -1, -1, 1.0 / 127, 0, 0, 0, 64.0 / 127}));
  EXPECT_EQ(positions_of<std::uint16_t>({0, 65535, 1, 0, 1, 0, 0, 0, 3}, true),
            (std::vector<double>{0, 1, 1.0 / 65535, 0, 1.0 / 65535, 0, 0, 0, 3.0 / 65535}));
}

TEST(GltfReader, PointsAreWeldedAtSeams) {
  GltfMaker maker;
  maker.add_mesh(maker.add_accessor<float>(
      {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, -0.0f, 0, 1, 0, 1, 1, 0}, "VEC3"));
  const ReadResult read = read_text(maker.glb(), "a");
  EXPECT_EQ(read.soup.points.size(), 4u);
  EXPECT_EQ(read.soup.triangles, (std::vector<Triangle>{{0, 1, 2}, {1, 2, 3}}));
  EXPECT_TRUE(read.report.warnings.empty());
}

TEST(GltfReader, ElementsMayBeInterleaved) {
  GltfMaker maker;
  const std::size_t view =
      maker.add_view(bytes_of(std::vector<float>{9, 0, 0, 0, 9, 9, 1, 0, 0, 9, 9, 0, 1, 0, 9}), 20);
  maker.add_mesh(maker.add("accessors", {{"bufferView", view},
                                         {"byteOffset", 4},
                                         {"componentType", 5126},
                                         {"count", 3},
                                         {"type", "VEC3"}}));
  EXPECT_EQ(coordinates(read_text(maker.glb(), "a").soup),
            (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0}));
}

TEST(GltfReader, SparseElementsReplaceOthers) {
  for (const bool has_base : {true, false}) {
    GltfMaker maker;
    TestJson accessor = {{"componentType", 5126}, {"count", 3}, {"type", "VEC3"}};
    if (has_base) {
      accessor["bufferView"] =
          maker.add_view(bytes_of(std::vector<float>{0, 0, 0, 5, 5, 5, 0, 0, 0}));
    }
    accessor["sparse"] = {
        {"count", 2},
        {"indices",
         {{"bufferView", maker.add_view(std::string("\1\2", 2))}, {"componentType", 5121}}},
        {"values",
         {{"bufferView", maker.add_view(bytes_of(std::vector<float>{1, 2, 3, 4, 5, 6}))}}}};
    maker.add_mesh(maker.add("accessors", accessor));
    EXPECT_EQ(coordinates(read_text(maker.glb(), "a").soup),
              (std::vector<double>{0, 0, 0, 1, 2, 3, 4, 5, 6}));
  }
}

std::vector<Triangle> triangles_of_mode(int mode, const std::vector<std::uint32_t>& indices) {
  GltfMaker maker;
  const std::size_t positions =
      maker.add_accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0}, "VEC3");
  maker.add_mesh(positions, maker.add_accessor<std::uint32_t>(indices, "SCALAR"))["mode"] = mode;
  return read_text(maker.glb(), "a").soup.triangles;
}

TEST(GltfReader, StripsAndFansBecomeTriangles) {
  EXPECT_THAT(triangles_of_mode(5, {0, 1, 2, 3, 4}),
              ElementsAre(Triangle{0, 1, 2}, Triangle{1, 3, 2}, Triangle{2, 3, 4}));
  EXPECT_THAT(triangles_of_mode(6, {0, 1, 2, 3}),
              ElementsAre(Triangle{0, 1, 2}, Triangle{1, 3, 2}));
  // Two strips in one, joined by triangles that are none.
  EXPECT_EQ(triangles_of_mode(5, {0, 1, 2, 2, 1, 1, 3, 4}).size(), 2u);
}

TEST(GltfReader, PointsAndLinesAreLeftOutWithAWarning) {
  GltfMaker maker = one_triangle();
  maker.root["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 1}});
  EXPECT_THAT(texts(read_text(maker.glb(), "a").report.warnings),
              ElementsAre("1 primitive of points or lines left out"));
}

TEST(GltfReader, TrianglesThatNameNoVerticesAreCounted) {
  GltfMaker maker;
  const std::size_t positions = maker.add_accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  maker.add_mesh(positions,
                 maker.add_accessor<std::uint32_t>({0, 1, 2, 0, 1, 4000000000u, 0}, "SCALAR"));
  const ReadResult read = read_text(maker.glb(), "a");
  EXPECT_EQ(read.soup.triangles.size(), 1u);
  EXPECT_EQ(read.report.bad_faces, 2u);
  EXPECT_THAT(texts(read.report.warnings), ElementsAre(HasSubstr("corners that are not there")));
}

TEST(GltfReader, NodesMoveTheirMeshes) {
  GltfMaker maker = one_triangle();
  maker.root["nodes"] = {
      {{"translation", {10, 0, 0}}, {"children", {1}}},
      {{"mesh", 0}, {"scale", {2, 3, 4}}, {"children", {2}}},
      {{"mesh", 0}, {"matrix", {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1}}}};
  const std::vector<double> expected = {10, 0, 0,  12, 0, 0,  10, 3, 0,  //
                                        10, 0, 20, 10, 3, 20, 8,  0, 20};
  EXPECT_EQ(coordinates(read_text(maker.glb(), "a").soup), expected);
}

TEST(GltfReader, QuarterTurnsAreExactEnough) {
  GltfMaker maker = one_triangle();
  maker.root["nodes"][0]["rotation"] = {0, 0, 0.70710677, 0.70710677};
  const TriangleSoup soup = read_text(maker.glb(), "a").soup;
  EXPECT_NEAR((soup.points[1] - Vec3d(0, 1, 0)).norm(), 0, 1e-15);
}

TEST(GltfReader, AMirrorTurnsTriangles) {
  GltfMaker maker = one_triangle();
  TestJson& attributes = maker.root["meshes"][0]["primitives"][0]["attributes"];
  attributes["NORMAL"] = maker.add_accessor<float>({0, 0, 1, 0, 0, 1, 1, 0, 0}, "VEC3");
  attributes["TANGENT"] = maker.add_accessor<float>({1, 0, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1}, "VEC4");
  maker.root["nodes"][0]["scale"] = {-2, 1, 1};
  const ReadResult read = read_all(maker.glb());
  EXPECT_EQ(coordinates(read.soup), (std::vector<double>{0, 0, 0, 0, 1, 0, -2, 0, 0}));
  EXPECT_EQ(values_at_corners(read.attributes.corners[0]),
            (std::vector<double>{0, 0, 1, -1, 0, 0, 0, 0, 1}));
  EXPECT_EQ(values_at_corners(read.attributes.corners[1]),
            (std::vector<double>{-1, 0, 0, -1, 0, 1, 0, -1, 0, 1, 0, -1}));
}

TEST(GltfReader, NormalsStayPerpendicular) {
  GltfMaker maker = one_triangle();
  const auto s = static_cast<float>(std::sqrt(0.5));
  maker.root["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
      maker.add_accessor<float>({s, s, 0, s, s, 0, s, s, 0}, "VEC3");
  maker.root["nodes"][0]["scale"] = {2, 1, 1};
  const std::vector<double> values = read_all(maker.glb()).attributes.corners[0].values;
  ASSERT_EQ(values.size(), 3u);
  EXPECT_NEAR(values[0], 1 / std::sqrt(5), 1e-7);
  EXPECT_NEAR(values[1], 2 / std::sqrt(5), 1e-7);
}

TEST(GltfReader, InstancesAreAllRead) {
  GltfMaker maker = one_triangle();
  maker.add_root({{"mesh", 0}, {"translation", {0, 0, 1}}});
  const std::size_t offsets = maker.add_accessor<float>({5, 0, 0, 6, 0, 0, 7, 0, 0}, "VEC3");
  const std::size_t turns =
      maker.add_accessor<std::int8_t>({0, 0, 0, 127, 0, 0, 0, 127, 0, 0, 127, 0}, "VEC4", true);
  maker.add_root({{"mesh", 0},
                  {"extensions",
                   {{"EXT_mesh_gpu_instancing",
                     {{"attributes", {{"TRANSLATION", offsets}, {"ROTATION", turns}}}}}}}});
  maker.root["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  const TriangleSoup soup = read_text(maker.glb(), "a").soup;
  ASSERT_EQ(soup.triangles.size(), 5u);
  EXPECT_EQ(soup.points[soup.triangles[1][0]], Vec3d(0, 0, 1));
  EXPECT_EQ(soup.points[soup.triangles[3][1]], Vec3d(7, 0, 0));
  EXPECT_EQ(soup.points[soup.triangles[4][1]], Vec3d(6, 0, 0));
}

TEST(GltfReader, OnlyTheDefaultSceneIsRead) {
  GltfMaker maker = one_triangle();
  maker.add("nodes", {{"mesh", 0}, {"translation", {0, 0, 7}}});
  maker.root["scenes"].push_back({{"nodes", {1}}});
  EXPECT_EQ(read_text(maker.glb(), "a").soup.points[0].z(), 0);
  maker.root["scene"] = 1;
  EXPECT_EQ(read_text(maker.glb(), "a").soup.points[0].z(), 7);
  maker.root.erase("scene");
  maker.root.erase("scenes");
  EXPECT_EQ(read_text(maker.glb(), "a").soup.triangles.size(), 2u);
}

TEST(GltfReader, LimitHoldsForInstances) {
  GltfMaker maker = one_triangle();
  for (int i = 0; i < 9; ++i) maker.add_root({{"mesh", 0}});
  ReadOptions options;
  options.max_triangles = 9;
  const std::string bytes = maker.glb();
  EXPECT_THROW((void)read_soup(std::string_view(bytes), "a", options), LimitError);
  options.max_triangles = 10;
  EXPECT_EQ(read_soup(std::string_view(bytes), "a", options).soup.triangles.size(), 10u);
}

TEST(GltfReader, AttributesHaveKindsNamesAndStorage) {
  GltfMaker maker = one_triangle();
  TestJson& attributes = maker.root["meshes"][0]["primitives"][0]["attributes"];
  attributes["TEXCOORD_10"] = maker.add_accessor<float>({1, 0, 1, 0, 1, 0.75f}, "VEC2");
  attributes["TEXCOORD_2"] = maker.add_accessor<std::uint8_t>({255, 0, 0, 255, 0, 0}, "VEC2", true);
  attributes["COLOR_0"] =
      maker.add_accessor<std::uint8_t>({255, 0, 51, 255, 0, 255, 0, 0, 1, 2, 3, 4}, "VEC4", true);
  attributes["_AGE"] = maker.add_accessor<float>({7, 8, 9}, "SCALAR");
  attributes["JOINTS_0"] = maker.add_accessor<std::uint8_t>(std::vector<std::uint8_t>(12), "VEC4");
  const std::vector<CornerAttribute> sets = read_all(maker.glb()).attributes.corners;
  ASSERT_EQ(sets.size(), 4u);
  EXPECT_EQ(sets[0].name, "TEXCOORD_2");
  EXPECT_EQ(values_at_corners(sets[0]), (std::vector<double>{1, 1, 0, 0, 0, 1}));
  EXPECT_EQ(sets[1].name, "TEXCOORD_10");
  EXPECT_EQ(values_at_corners(sets[1]), (std::vector<double>{1, 1, 1, 1, 1, 0.25}));
  EXPECT_EQ(sets[1].of_corner[0], sets[1].of_corner[1]);
  EXPECT_EQ(sets[2].kind, Kind::colour);
  EXPECT_EQ(sets[2].storage, CornerAttribute::Storage::byte);
  EXPECT_EQ(sets[2].values[2], 0.2);
  EXPECT_EQ(sets[3].kind, Kind::other);
  EXPECT_EQ(sets[3].name, "_AGE");
  EXPECT_EQ(values_at_corners(sets[3]), (std::vector<double>{7, 8, 9}));
}

TEST(GltfReader, PrimitivesMayHaveDifferentAttributes) {
  GltfMaker maker = one_triangle();
  TestJson& primitives = maker.root["meshes"][0]["primitives"];
  primitives.push_back(primitives[0]);
  primitives.push_back(primitives[0]);
  primitives[1]["attributes"]["COLOR_0"] =
      maker.add_accessor<std::uint8_t>({255, 0, 0, 0, 255, 0, 0, 0, 255}, "VEC3", true);
  primitives[2]["attributes"]["COLOR_0"] =
      maker.add_accessor<float>({1, 0, 0, 0, 0, 1, 0, 0.5f, 0, 0, 1, 1}, "VEC4");
  const CornerAttribute colours = read_all(maker.glb()).attributes.corners.at(0);
  EXPECT_EQ(colours.components, 4u);
  EXPECT_EQ(colours.storage, CornerAttribute::Storage::real32);
  EXPECT_EQ(colours.of_corner[2], kNone);
  EXPECT_EQ(colours.values[4 * colours.of_corner[3] + 3], 1);
  EXPECT_EQ(colours.values[4 * colours.of_corner[6] + 3], 0);
}

TEST(GltfReader, NamesOfNodesAreObjects) {
  GltfMaker maker = one_triangle();
  maker.root["nodes"][0]["name"] = "left";
  maker.add_root({{"mesh", 0}, {"name", "right"}});
  const TriangleLabels objects = read_all(maker.glb()).attributes.objects;
  EXPECT_THAT(objects.names, ElementsAre("left", "right"));
  EXPECT_THAT(objects.of_triangle, ElementsAre(0, 1));
}

TEST(GltfReader, MaterialsGetNamesThatTellThemApart) {
  GltfMaker maker = one_triangle();
  for (const char* name : {"a", "", "a", "a_2", "material_1"})
    maker.add("materials", {{"name", name}});
  maker.root["meshes"][0]["primitives"][0]["material"] = 2;
  const TriangleLabels materials = read_all(maker.glb()).attributes.materials;
  EXPECT_THAT(materials.names, ElementsAre("a", "material_1", "a_2", "a_2_3", "material_1_4"));
  EXPECT_THAT(materials.of_triangle, ElementsAre(2));
}

TEST(GltfReader, BuffersAreDataUrisOrFilesBesideIt) {
  const TemporaryFolder folder;
  const GltfMaker maker = one_triangle();
  std::filesystem::create_directory(folder.path() / "b c");
  std::ofstream(folder.path() / "b c" / "x.bin", std::ios::binary) << maker.buffer;
  std::ofstream(folder.path() / "a.gltf") << maker.gltf("b%20c/x.bin");
  EXPECT_EQ(read_soup(folder.path() / "a.gltf").soup.triangles.size(), 1u);
  EXPECT_THAT(refusal_of(maker.gltf("b%20c/x.bin"), "a.gltf"), HasSubstr("is not in its folder"));
}

TEST(GltfReader, SkinsAndMorphTargetsAreReadAtRestWithAWarning) {
  GltfMaker maker = one_triangle();
  maker.root["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", 0}}};
  maker.add("skins", {{"joints", {0}}});
  maker.root["nodes"][0]["skin"] = 0;
  maker.root["nodes"][0]["translation"] = {1, 2, 3};
  const ReadResult read = read_text(maker.glb(), "a");
  EXPECT_EQ(read.soup.points[0], Vec3d(0, 0, 0));
  EXPECT_EQ(read.report.warnings.size(), 2u);
}

TEST(GltfReader, CompressedBufferViewsAreRead) {
  std::vector<float> positions;
  std::vector<std::uint32_t> indices;
  for (std::uint32_t i = 0; i < 90; ++i) {
    for (std::uint32_t k = 0; k < 3; ++k) positions.push_back(static_cast<float>(i * i + k));
    indices.push_back(i);
  }
  GltfMaker maker;
  std::string packed(meshopt_encodeVertexBufferBound(90, 12), '\0');
  const auto bytes = [](std::string& text) {
    return reinterpret_cast<unsigned char*>(text.data());
  };
  packed.resize(meshopt_encodeVertexBuffer(bytes(packed), packed.size(), positions.data(), 90, 12));
  std::string packed_indices(meshopt_encodeIndexBufferBound(90, 90), '\0');
  packed_indices.resize(meshopt_encodeIndexBuffer(bytes(packed_indices), packed_indices.size(),
                                                  indices.data(), indices.size()));
  const auto compress = [&](const std::string& data, std::size_t stride, const char* mode) {
    const std::size_t view = maker.add_view(data);
    TestJson& json = maker.root["bufferViews"][view];
    json["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0},
                                                     {"byteOffset", json["byteOffset"]},
                                                     {"byteLength", data.size()},
                                                     {"byteStride", stride},
                                                     {"count", 90},
                                                     {"mode", mode}};
    json["buffer"] = 1;
    return view;
  };
  const std::size_t vertices = compress(packed, 12, "ATTRIBUTES");
  const std::size_t triangles = compress(packed_indices, 4, "TRIANGLES");
  maker.add("accessors",
            {{"bufferView", vertices}, {"componentType", 5126}, {"count", 90}, {"type", "VEC3"}});
  maker.add(
      "accessors",
      {{"bufferView", triangles}, {"componentType", 5125}, {"count", 90}, {"type", "SCALAR"}});
  maker.add_mesh(0, 1);
  maker.root["buffers"] = {{{"byteLength", maker.buffer.size()}}, {{"byteLength", 5000}}};
  maker.root["extensionsRequired"] = {"EXT_meshopt_compression"};
  EXPECT_EQ(coordinates(read_text(maker.glb(), "a").soup),
            std::vector<double>(positions.begin(), positions.end()));
}

}  // namespace
}  // namespace meshrepair
