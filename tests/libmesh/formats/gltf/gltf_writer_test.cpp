// SPDX-License-Identifier: MIT
// What is written as glTF comes back.
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <iterator>
#include <memory>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <mesh/soup_io.h>

#include "each_seed.h"
#include "gltf_maker.h"
#include "soup_fixtures.h"
#include "temporary_folder.h"
#include "textured_soups.h"
#include "warning_texts.h"

namespace meshrepair {
namespace {

using Kind = CornerAttribute::Kind;
using ::testing::HasSubstr;

const std::string kPicture("\x89PNG\r\n\x1A\n\0\1\2\3picture", 19);

ReadResult read_with_attributes(const std::string& bytes, const std::string& name) {
  ReadOptions options;
  options.attributes = true;
  return read_soup(std::string_view(bytes), name, options);
}

ReadResult read_with_attributes(const std::filesystem::path& path) {
  ReadOptions options;
  options.attributes = true;
  return read_soup(path, options);
}

TestJson json_of(const std::string& bytes) {
  if (!bytes.starts_with("glTF")) return TestJson::parse(bytes);
  std::uint32_t size = 0;
  std::memcpy(&size, bytes.data() + 12, 4);
  return TestJson::parse(bytes.substr(20, size));
}

// The bytes of a buffer view of a .glb.
std::string view_bytes(const std::string& glb, const TestJson& root, std::size_t view) {
  std::uint32_t size = 0;
  std::memcpy(&size, glb.data() + 12, 4);
  const TestJson& json = root["bufferViews"][view];
  return glb.substr(28 + size + json["byteOffset"].get<std::size_t>(),
                    json["byteLength"].get<std::size_t>());
}

void write_file(const std::filesystem::path& path, const std::string& bytes) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << bytes;
}

std::string file_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

template <class A, class B>
std::string differences(const A& a, const B& b) {
  return difference(facts_of(a.soup, a.attributes), facts_of(b.soup, b.attributes));
}

class GltfDialects : public ::testing::TestWithParam<SoupFormat> {};

TEST_P(GltfDialects, TexturedSoupsComeBackBitForBit) {
  for_each_seed(1, 30, [&](std::uint64_t seed) {
    const TexturedSoup made = random_textured_soup(seed);
    const std::string bytes = format_soup(made.soup, GetParam(), {.attributes = &made.attributes});
    const ReadResult back = read_with_attributes(bytes, "a");
    ASSERT_TRUE(back.report.warnings.empty());
    ASSERT_EQ(differences(back, made), "") << seed;
    // And once more, now with what was kept.
    const ReadResult again = read_with_attributes(
        format_soup(back.soup, GetParam(), {.attributes = &back.attributes}), "a");
    ASSERT_EQ(differences(again, made), "") << seed;
  });
}

TEST_P(GltfDialects, WritingTwiceGivesTheSameBytes) {
  const TexturedSoup made = random_textured_soup(5);
  const auto write = [&] {
    return format_soup(made.soup, GetParam(), {.attributes = &made.attributes});
  };
  EXPECT_EQ(write(), write());
}

TEST_P(GltfDialects, ObjComesBackThroughIt) {
  TexturedSoup made = random_textured_soup(9);
  // What OBJ has of it.
  std::erase_if(made.attributes.corners, [&](const CornerAttribute& set) {
    return set.kind > Kind::normal || &set == &made.attributes.corners[1];
  });
  std::erase(made.attributes.materials.of_triangle, kNone);
  made.attributes.materials.of_triangle.resize(made.soup.triangles.size(), 1);
  const auto through = [](const ReadResult& read, SoupFormat format) {
    return read_with_attributes(format_soup(read.soup, format, {.attributes = &read.attributes}),
                                "a");
  };
  const ReadResult obj = read_with_attributes(
      format_soup(made.soup, SoupFormat::obj, {.attributes = &made.attributes}), "a");
  ASSERT_EQ(differences(obj, made), "");
  const ReadResult back = through(through(obj, GetParam()), SoupFormat::obj);
  EXPECT_EQ(differences(back, made), "");
}

TEST_P(GltfDialects, CornersWithoutValuesGetSomeThatSayNothing) {
  TexturedSoup made = random_textured_soup(3);
  made.attributes.materials = {};
  for (CornerAttribute& set : made.attributes.corners) set.of_corner[4] = kNone;
  const ReadResult back = read_with_attributes(
      format_soup(made.soup, GetParam(), {.attributes = &made.attributes}), "a");
  ASSERT_EQ(back.attributes.corners.size(), made.attributes.corners.size());
  const auto value = [&](std::size_t set, std::size_t i) {
    const CornerAttribute& attribute = back.attributes.corners[set];
    return attribute.values[attribute.components * attribute.of_corner[4] + i];
  };
  EXPECT_EQ(value(0, 0), 0);
  EXPECT_EQ(value(4, 3), 1);
  const Vec3d normal(value(2, 0), value(2, 1), value(2, 2));
  EXPECT_NEAR(normal.norm(), 1, 1e-6);
}

TEST_P(GltfDialects, CommentsAndTheProgramAreInTheAsset) {
  const TestJson root = json_of(format_soup(tetrahedron(), GetParam(), {{"one", "two"}}));
  EXPECT_EQ(root["asset"]["generator"], "meshrepair");
  EXPECT_EQ(root["asset"]["extras"]["comments"], TestJson({"one", "two"}));
}

INSTANTIATE_TEST_SUITE_P(Both, GltfDialects, ::testing::Values(SoupFormat::glb, SoupFormat::gltf),
                         [](const auto& tested) {
                           return tested.param == SoupFormat::glb ? "Glb" : "Gltf";
                         });

TEST(GltfWriter, CoordinatesBeyondSinglePrecisionAreRefused) {
  TriangleSoup soup = tetrahedron();
  soup.points[2] = {0, 1e39, 0};
  EXPECT_THROW((void)format_soup(soup, SoupFormat::glb), OutputError);
}

TEST(GltfWriter, EqualCornersShareAVertex) {
  const TestJson root = json_of(format_soup(tetrahedron(), SoupFormat::glb));
  const TestJson& primitive = root["meshes"][0]["primitives"][0];
  const TestJson& positions =
      root["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()];
  EXPECT_EQ(positions["count"], 4);
  EXPECT_EQ(positions["min"], TestJson({0.0, 0.0, 0.0}));
  EXPECT_EQ(positions["max"], TestJson({1.0, 1.0, 1.0}));
}

TEST(GltfWriter, LooksBecomeMaterialsAndImagesStayAsTheyAre) {
  TexturedSoup made = random_textured_soup(2);
  made.attributes.images = {{"a.png", "image/png", {}, std::make_shared<std::string>(kPicture)}};
  made.attributes.looks = {{{1, 0, 0, 0.5}, kNone}, {{1, 1, 1, 1}, 0}, {}};
  const std::string glb = format_soup(made.soup, SoupFormat::glb, {.attributes = &made.attributes});
  const TestJson root = json_of(glb);
  EXPECT_EQ(root["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"],
            TestJson({1.0, 0.0, 0.0, 0.5}));
  EXPECT_EQ(view_bytes(glb, root, root["images"][0]["bufferView"].get<std::size_t>()), kPicture);
  const ReadResult back = read_with_attributes(glb, "a");
  EXPECT_EQ(back.attributes.materials.names, made.attributes.materials.names);
  EXPECT_EQ(back.attributes.looks[0].colour, made.attributes.looks[0].colour);
  EXPECT_EQ(back.attributes.looks[1].image, 0u);
  EXPECT_EQ(*back.attributes.images[0].bytes, kPicture);
}

TEST(GltfWriter, NamesOfImagesAreRelativeToTheFile) {
  const TemporaryFolder folder;
  write_file(folder.path() / "in" / "my pictures" / "a.png", kPicture);
  GltfMaker maker = one_triangle();
  maker.add("images", {{"uri", "my%20pictures/a.png"}});
  maker.add("textures", {{"source", 0}});
  maker.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
  maker.root["meshes"][0]["primitives"][0]["material"] = 0;
  write_file(folder.path() / "in" / "a.glb", maker.glb());
  const ReadResult read = read_with_attributes(folder.path() / "in" / "a.glb");
  ASSERT_EQ(read.attributes.images.size(), 1u);
  EXPECT_EQ(read.attributes.images[0].path, folder.path() / "in" / "my pictures" / "a.png");
  const auto uri_in = [&](const std::filesystem::path& path) {
    std::filesystem::create_directories(path.parent_path());
    write_soup(read.soup, path, {.extras = {.attributes = &read.attributes}});
    return json_of(file_bytes(path))["images"][0]["uri"];
  };
  EXPECT_EQ(uri_in(folder.path() / "in" / "b.glb"), "my%20pictures/a.png");
  EXPECT_EQ(uri_in(folder.path() / "out" / "b.gltf"), "../in/my%20pictures/a.png");
}

TEST(GltfWriter, ImageFilesOfOtherFormatsAreNamed) {
  TexturedSoup made = random_textured_soup(4);
  const std::filesystem::path folder = std::filesystem::temp_directory_path();
  made.attributes.images = {{"ä.png", {}, (folder / "in" / "ä.png").string(), nullptr}};
  made.attributes.looks = {{{1, 1, 1, 1}, 0}, {}, {{1, 1, 1, 1}, 0}};
  const TemporaryFolder out;
  write_soup(made.soup, out.path() / "a.glb", {.extras = {.attributes = &made.attributes}});
  const TestJson root = json_of(file_bytes(out.path() / "a.glb"));
  ASSERT_EQ(root["images"].size(), 1u);
  EXPECT_EQ(root["images"][0]["uri"], "../in/%C3%A4.png");
  EXPECT_EQ(root["textures"].size(), 1u);
  EXPECT_EQ(root["materials"][2]["pbrMetallicRoughness"]["baseColorTexture"]["index"], 0);
}

// A file with all that a repair has to leave alone.
GltfMaker rich_file() {
  GltfMaker maker = one_triangle();
  const std::size_t picture = maker.add_view(kPicture);
  const std::size_t times = maker.add_accessor<float>({0, 1}, "SCALAR");
  const std::size_t moves = maker.add_accessor<float>({0, 0, 0, 1, 2, 3}, "VEC3");
  const std::size_t weights = maker.add_accessor<float>({0, 1}, "SCALAR");
  maker.add("images", {{"bufferView", picture}, {"mimeType", "image/png"}, {"name", "p"}});
  maker.add("images", {{"uri", "data:image/png;base64,AAECAw=="}, {"extras", {1, 2}}});
  maker.add("samplers", {{"magFilter", 9728}, {"wrapS", 33071}});
  maker.add("textures", {{"source", 0}, {"sampler", 0}});
  maker.add("materials", {{"name", "steel"},
                          {"doubleSided", true},
                          {"pbrMetallicRoughness",
                           {{"baseColorTexture", {{"index", 0}}}, {"roughnessFactor", 0.25}}},
                          {"extensions", {{"KHR_materials_clearcoat", {{"clearcoatFactor", 1}}}}}});
  maker.add("materials", {{"name", "steel"}, {"extras", {{"note", "\u00e9"}}}});
  maker.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}});
  maker.root["extensionsUsed"] = {"KHR_materials_clearcoat", "KHR_lights_punctual",
                                  "KHR_mesh_quantization"};
  maker.root["extensionsRequired"] = {"KHR_mesh_quantization"};
  maker.root["extensions"] = {{"KHR_lights_punctual", {{"lights", {{{"type", "point"}}}}}}};
  maker.root["extras"] = {{"anything", {1, "two", nullptr}}};
  maker.root["asset"]["copyright"] = "someone";
  maker.root["meshes"][0]["primitives"][0]["material"] = 1;
  maker.root["meshes"][0]["weights"] = {0.5};
  maker.add("skins", {{"joints", {1}}});
  maker.root["nodes"][0]["weights"] = {0.5};
  maker.root["nodes"][0]["children"] = {1};
  maker.root["nodes"][0]["name"] = "part";
  maker.add("nodes", {{"camera", 0}, {"translation", {1, 2, 3}}, {"name", "eye"}});
  maker.add("animations",
            {{"channels",
              {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}},
               {{"sampler", 1}, {"target", {{"node", 0}, {"path", "weights"}}}}}},
             {"samplers",
              {{{"input", times}, {"output", moves}}, {{"input", times}, {"output", weights}}}}});
  return maker;
}

TEST(GltfWriter, WhatIsNoMeshStaysUntouched) {
  const GltfMaker maker = rich_file();
  ReadResult read = read_with_attributes(maker.glb(), "a.glb");
  EXPECT_EQ(read.attributes.materials.names, (std::vector<std::string>{"steel", "steel_1"}));
  read.attributes.materials.names.emplace_back("meshrepair_patch");
  read.attributes.materials.of_triangle.push_back(2);
  read.attributes.objects.of_triangle.push_back(0);
  read.soup.triangles.push_back(read.soup.triangles.front());
  const std::string glb = format_soup(read.soup, SoupFormat::glb, {.attributes = &read.attributes});
  const TestJson root = json_of(glb);
  for (const char* key : {"samplers", "textures", "cameras", "extensions", "extras"}) {
    EXPECT_EQ(root[key], maker.root[key]) << key;
  }
  EXPECT_EQ(root["images"][1], maker.root["images"][1]);
  EXPECT_EQ(root["images"][0]["name"], "p");
  EXPECT_EQ(view_bytes(glb, root, root["images"][0]["bufferView"].get<std::size_t>()), kPicture);
  ASSERT_EQ(root["materials"].size(), 3u);
  EXPECT_EQ(root["materials"][0], maker.root["materials"][0]);
  EXPECT_EQ(root["materials"][1], maker.root["materials"][1]);
  EXPECT_EQ(root["materials"][2]["name"], "meshrepair_patch");
  EXPECT_EQ(root["asset"]["copyright"], "someone");
  EXPECT_EQ(root["extensionsUsed"], TestJson({"KHR_materials_clearcoat", "KHR_lights_punctual"}));
  EXPECT_FALSE(root.contains("extensionsRequired"));
}

TEST(GltfWriter, OneNodeHasTheMeshAndTheOthersStay) {
  const GltfMaker maker = rich_file();
  const ReadResult read = read_with_attributes(maker.glb(), "a.glb");
  const std::string glb = format_soup(read.soup, SoupFormat::glb, {.attributes = &read.attributes});
  const TestJson root = json_of(glb);
  EXPECT_EQ(root["skins"], maker.root["skins"]);
  ASSERT_EQ(root["nodes"].size(), 3u);
  EXPECT_EQ(root["nodes"][0], TestJson({{"children", {1}}, {"name", "part"}}));
  EXPECT_EQ(root["nodes"][1], maker.root["nodes"][1]);
  EXPECT_EQ(root["nodes"][2], TestJson({{"mesh", 0}, {"name", "part"}}));
  EXPECT_EQ(root["scenes"][0]["nodes"], TestJson({0, 2}));
  ASSERT_EQ(root["meshes"].size(), 1u);
  EXPECT_EQ(root["meshes"][0]["primitives"][0]["material"], 1);
}

TEST(GltfWriter, AnimationsOfNodesStayThoseOfWeightsGo) {
  const ReadResult read = read_with_attributes(rich_file().glb(), "a.glb");
  const std::string glb = format_soup(read.soup, SoupFormat::glb, {.attributes = &read.attributes});
  const TestJson root = json_of(glb);
  ASSERT_EQ(root["animations"].size(), 1u);
  const TestJson& animation = root["animations"][0];
  ASSERT_EQ(animation["channels"].size(), 1u);
  EXPECT_EQ(animation["channels"][0]["target"]["path"], "translation");
  const TestJson& moves = root["accessors"][animation["samplers"][0]["output"].get<std::size_t>()];
  EXPECT_EQ(moves["type"], "VEC3");
  EXPECT_EQ(view_bytes(glb, root, moves["bufferView"].get<std::size_t>()),
            bytes_of(std::vector<float>{0, 0, 0, 1, 2, 3}));
}

TEST(GltfWriter, TextureCoordinatesComeBackToTheLastBit) {
  const std::vector<float> coordinates = {0.25f,   1e-12f, 0.5f, 1.17549435e-38f,
                                          -3e-20f, -0.75f, 7e8f, 0.1f};
  for (const float v : coordinates) {
    GltfMaker maker = one_triangle();
    maker.root["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] =
        maker.add_accessor<float>({0.5f, v, 0, 0.1f, 1, 0.3f}, "VEC2");
    const ReadResult read = read_with_attributes(maker.glb(), "a.glb");
    EXPECT_EQ(read.attributes.corners[0].values[1], 1 - static_cast<double>(v));
    const std::string glb =
        format_soup(read.soup, SoupFormat::glb, {.attributes = &read.attributes});
    const TestJson root = json_of(glb);
    const std::size_t accessor =
        root["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"].get<std::size_t>();
    EXPECT_EQ(view_bytes(glb, root, root["accessors"][accessor]["bufferView"].get<std::size_t>()),
              bytes_of(std::vector<float>{0.5f, v, 0, 0.1f, 1, 0.3f}))
        << v;
  }
}

// Triangles side by side, each a primitive: of these materials, which are others in variants.
GltfMaker with_variants(const std::vector<std::pair<int, int>>& materials) {
  GltfMaker maker;
  maker.root["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "night"}}};
  maker.root["extensionsUsed"] = {"KHR_materials_variants"};
  for (const char* const name : {"a", "b", "c"}) maker.add("materials", {{"name", name}});
  TestJson primitives = TestJson::array();
  for (const auto& [material, other] : materials) {
    const auto x = static_cast<float>(primitives.size());
    TestJson primitive = {
        {"attributes",
         {{"POSITION", maker.add_accessor<float>({x, 0, 0, x + 1, 0, 0, x, 1, 0}, "VEC3")}}},
        {"material", material}};
    if (other >= 0) {
      primitive["extensions"]["KHR_materials_variants"]["mappings"] = {
          {{"material", other}, {"variants", {0}}}};
    }
    primitives.push_back(std::move(primitive));
  }
  maker.add("meshes", {{"primitives", std::move(primitives)}});
  maker.add_root({{"mesh", 0}});
  return maker;
}

TEST(GltfWriter, VariantsStayWhereTheyAreThoseOfAMaterial) {
  const GltfMaker maker = with_variants({{0, 1}, {1, 2}, {0, 1}, {2, -1}});
  for (const bool by_mesh : {false, true}) {
    ReadOptions options;
    options.attributes = true;
    options.by_mesh = by_mesh;
    const ReadResult read = read_soup(std::string_view(maker.glb()), "a", options);
    EXPECT_TRUE(read.report.warnings.empty());
    SoupExtras extras{.attributes = &read.attributes};
    if (by_mesh) extras.scene = &read.scene;
    const TestJson root = json_of(format_soup(read.soup, SoupFormat::glb, extras));
    EXPECT_EQ(root["extensions"], maker.root["extensions"]);
    const TestJson& before = maker.root["meshes"][0]["primitives"];
    const TestJson& after = root["meshes"][0]["primitives"];
    ASSERT_EQ(after.size(), 3u);
    EXPECT_EQ(after[0]["extensions"], before[0]["extensions"]);
    EXPECT_EQ(after[1]["extensions"], before[1]["extensions"]);
    EXPECT_FALSE(after[2].contains("extensions"));
  }
}

TEST(GltfWriter, VariantsThatPrimitivesOfOneMaterialDoNotShareGoWithAWarning) {
  for (const int other : {-1, 2}) {
    const GltfMaker maker = with_variants({{0, 1}, {1, 2}, {0, other}});
    const ReadResult read = read_with_attributes(maker.glb(), "a");
    EXPECT_EQ(texts(read.report.warnings),
              (std::vector<std::string>{
                  "the variants of 1 material left out: primitives have different ones"}));
    const TestJson root =
        json_of(format_soup(read.soup, SoupFormat::glb, {.attributes = &read.attributes}));
    const TestJson& after = root["meshes"][0]["primitives"];
    EXPECT_FALSE(after[0].contains("extensions"));
    EXPECT_TRUE(after[1].contains("extensions"));
  }
}

}  // namespace
}  // namespace meshrepair
