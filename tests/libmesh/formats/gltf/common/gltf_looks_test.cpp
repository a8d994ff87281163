// SPDX-License-Identifier: MIT
// Attributes of several glTF files as one: materials come out as each file had them.
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <mesh/soup_io.h>

#include "gltf_maker.h"

namespace meshrepair {
namespace {

// A triangle with a material of which other formats can say little, and a picture.
GltfMaker painted(const std::string& picture, double metal, const std::string& name = "paint") {
  GltfMaker maker;
  maker.add_mesh(maker.add_accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3"))["material"] = 1;
  maker.root["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] =
      maker.add_accessor<float>({0, 0, 1, 0, 0, 1}, "VEC2");
  maker.add("images", {{"uri", "data:image/png;base64,iVBORw0KGgo="}});
  maker.add("images", {{"bufferView", maker.add_view(picture)}, {"mimeType", "image/png"}});
  maker.add("samplers", {{"wrapS", 33071}});
  maker.add("textures", {{"source", 0}});
  maker.add("textures", {{"sampler", 0}, {"extensions", {{"EXT_texture_webp", {{"source", 1}}}}}});
  maker.add("materials", {{"name", "spare"}, {"emissiveFactor", {metal, 0, 0}}});
  const TestJson transform = {{"KHR_texture_transform", {{"scale", {2, 2}}}}};
  maker.add("materials", {{"name", name},
                          {"doubleSided", true},
                          {"pbrMetallicRoughness",
                           {{"metallicFactor", metal},
                            {"baseColorTexture", {{"index", 1}, {"extensions", transform}}}}},
                          {"extensions",
                           {{"KHR_materials_clearcoat", {{"clearcoatTexture", {{"index", 0}}}}}}}});
  maker.root["extensionsUsed"] = {"EXT_texture_webp", "KHR_texture_transform",
                                  "KHR_materials_clearcoat", "KHR_lights_punctual"};
  maker.root["extensionsRequired"] = {"KHR_texture_transform"};
  return maker;
}

ReadResult read_file(const GltfMaker& maker) {
  ReadOptions options;
  options.attributes = true;
  return read_soup(std::string_view(maker.glb()), "a.glb", options);
}

void append_read(ReadResult& all, ReadResult other) {
  append_attributes(all.attributes, all.soup.triangles.size(), std::move(other.attributes),
                    other.soup.triangles.size());
  const auto base = static_cast<std::uint32_t>(all.soup.points.size());
  for (const Vec3d& point : other.soup.points) all.soup.points.push_back(point);
  for (const auto& [a, b, c] : other.soup.triangles) {
    all.soup.triangles.push_back({a + base, b + base, c + base});
  }
}

// A document and its bytes.
struct Written {
  explicit Written(const ReadResult& read)
      : glb(format_soup(read.soup, SoupFormat::glb, {.attributes = &read.attributes})) {
    std::memcpy(&json_size, glb.data() + 12, 4);
    root = TestJson::parse(glb.substr(20, json_size));
  }

  // The material of the primitive, with its textures in place of their numbers.
  [[nodiscard]] TestJson material_of(std::size_t primitive) const {
    const std::size_t number = root["meshes"][0]["primitives"][primitive]["material"];
    TestJson material = root["materials"][number];
    resolve(material["pbrMetallicRoughness"]["baseColorTexture"]);
    resolve(material["extensions"]["KHR_materials_clearcoat"]["clearcoatTexture"]);
    return material;
  }

  [[nodiscard]] std::string bytes_of_view(std::size_t view) const {
    const TestJson& json = root["bufferViews"][view];
    return glb.substr(28 + json_size + json["byteOffset"].get<std::size_t>(),
                      json["byteLength"].get<std::size_t>());
  }

  std::string glb;
  std::uint32_t json_size = 0;
  TestJson root;

 private:
  void resolve(TestJson& use) const {
    TestJson texture = root["textures"][use["index"].get<std::size_t>()];
    if (texture.contains("sampler")) {
      texture["sampler"] = root["samplers"][texture["sampler"].get<std::size_t>()];
    }
    TestJson& owner =
        texture.contains("source") ? texture : texture["extensions"]["EXT_texture_webp"];
    TestJson image = root["images"][owner["source"].get<std::size_t>()];
    if (image.contains("bufferView")) {
      image["bufferView"] = bytes_of_view(image["bufferView"].get<std::size_t>());
    }
    owner["source"] = std::move(image);
    use["index"] = std::move(texture);
  }
};

TEST(GltfLooks, MaterialsOfAllFilesComeOutAsTheyWere) {
  const std::vector<GltfMaker> files = {painted("first", 0), painted("second", 0.5),
                                        painted("third", 1, "other")};
  ReadResult all = read_file(files[0]);
  for (std::size_t i = 1; i < files.size(); ++i) append_read(all, read_file(files[i]));
  const Written written(all);
  ASSERT_EQ(written.root["meshes"][0]["primitives"].size(), 3u);
  for (std::size_t i = 0; i < files.size(); ++i) {
    EXPECT_EQ(written.material_of(i), Written(read_file(files[i])).material_of(0)) << i;
  }
  EXPECT_EQ(written.root["materials"].size(), 6u);
  EXPECT_EQ(written.root["materials"][3]["name"], "paint");
  // What is the same in all is there once.
  EXPECT_EQ(written.root["images"].size(), 4u);
  EXPECT_EQ(written.root["samplers"].size(), 1u);
  EXPECT_EQ(written.root["textures"].size(), 4u);
  EXPECT_EQ(all.attributes.materials.names,
            (std::vector<std::string>{"spare", "paint", "spare_2", "paint_2", "spare_3", "other"}));
}

TEST(GltfLooks, OneFileTwiceHasItsMaterialsOnce) {
  ReadResult all = read_file(painted("picture", 0));
  append_read(all, read_file(painted("picture", 0)));
  const Written written(all);
  const TestJson once = Written(read_file(painted("picture", 0))).root;
  for (const char* list : {"materials", "textures", "images", "samplers", "extensionsUsed"}) {
    EXPECT_EQ(written.root[list].size(), once[list].size()) << list;
  }
  EXPECT_EQ(written.root["meshes"][0]["primitives"].size(), 1u);
}

TEST(GltfLooks, ExtensionsThatComeAlongAreNamed) {
  GltfMaker plain;
  plain.add_mesh(plain.add_accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3"));
  ReadResult all = read_file(plain);
  append_read(all, read_file(painted("picture", 0)));
  const Written written(all);
  EXPECT_EQ(written.root["extensionsUsed"],
            TestJson({"EXT_texture_webp", "KHR_texture_transform", "KHR_materials_clearcoat"}));
  EXPECT_EQ(written.root["extensionsRequired"], TestJson({"KHR_texture_transform"}));
  EXPECT_EQ(written.material_of(0), Written(read_file(painted("picture", 0))).material_of(0));
}

TEST(GltfLooks, MaterialsBehindThoseOfAnotherFormatStayTheirs) {
  ReadResult all;
  all.soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  all.soup.triangles = {{0, 1, 2}};
  all.attributes.materials = {{"paint"}, {0}};
  append_read(all, read_file(painted("picture", 0)));
  const Written written(all);
  ASSERT_EQ(written.root["meshes"][0]["primitives"].size(), 2u);
  const std::size_t first = written.root["meshes"][0]["primitives"][0]["material"];
  EXPECT_EQ(written.root["materials"][first]["pbrMetallicRoughness"],
            TestJson({{"metallicFactor", 0.0}}));
  EXPECT_EQ(written.material_of(1), Written(read_file(painted("picture", 0))).material_of(0));
}

TEST(GltfLooks, TexturesTakeTheSetsOfCoordinatesThatTheyTook) {
  ReadResult all;
  all.soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  all.soup.triangles = {{0, 1, 2}};
  CornerAttribute& set = all.attributes.corners.emplace_back();
  set.values = {0.5, 0.5};
  set.of_corner = {0, 0, 0};
  append_read(all, read_file(painted("picture", 0)));
  const Written written(all);
  const TestJson material = written.material_of(0);
  EXPECT_EQ(material["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"], 1);
  EXPECT_EQ(material["extensions"]["KHR_materials_clearcoat"]["clearcoatTexture"]["texCoord"], 1);
  const ReadResult again = read_soup(std::string_view(written.glb), "b.glb", {.attributes = true});
  EXPECT_EQ(again.attributes.looks[1].texture_set, 1u);
}

TEST(GltfLooks, NumbersOfNothingAreLeftOut) {
  GltfMaker broken = painted("picture", 0);
  broken.root["materials"][1]["normalTexture"] = {{"index", 7}};
  broken.root["textures"][0]["sampler"] = 1e300;
  ReadResult all = read_file(painted("first", 0));
  append_read(all, read_file(broken));
  const Written written(all);
  EXPECT_EQ(written.root["materials"].back()["normalTexture"], TestJson::object());
  // The texture is the same without its sampler.
  EXPECT_EQ(written.root["textures"].size(), 3u);
}

TEST(GltfLooks, VariantsAreThoseOfTheFirstFileAlone) {
  GltfMaker maker = painted("picture", 0);
  maker.root["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "night"}}};
  maker.root["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"] = {
      {{"material", 0}, {"variants", {0}}}};
  ReadResult all = read_file(maker);
  append_read(all, read_file(maker));
  append_read(all, read_file(painted("picture", 0)));
  const TestJson primitives = Written(all).root["meshes"][0]["primitives"];
  ASSERT_EQ(primitives.size(), 2u);
  EXPECT_EQ(primitives[0]["extensions"], maker.root["meshes"][0]["primitives"][0]["extensions"]);
  EXPECT_FALSE(primitives[1].contains("extensions"));
}

}  // namespace
}  // namespace meshrepair
