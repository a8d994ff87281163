// SPDX-License-Identifier: MIT
// Files that lie: each is refused with one line, or read with a warning.
#include <filesystem>
#include <fstream>
#include <functional>
#include <gmock/gmock.h>
#include <string>

#include <gtest/gtest.h>

#include <mesh/soup_io.h>

#include "gltf_maker.h"
#include "soup_fixtures.h"
#include "temporary_folder.h"

namespace meshrepair {
namespace {

using ::testing::HasSubstr;

struct OddFile {
  std::string name;
  std::string bytes;
  std::string message;  // part of it; of a warning if the file is read
  bool is_read = false;
};

// One triangle, changed.
std::string changed(const std::function<void(GltfMaker&)>& change) {
  GltfMaker maker = one_triangle();
  change(maker);
  return maker.glb();
}

// With another value at a place of its JSON.
std::string with(const char* place, TestJson value) {
  return changed([&](GltfMaker& maker) {
    maker.root["buffers"] = {{{"byteLength", maker.buffer.size()}}};
    maker.root[TestJson::json_pointer(place)] = std::move(value);
  });
}

std::string overwritten(std::string bytes, std::size_t at, const std::string& by) {
  return bytes.replace(at, by.size(), by);
}

std::string nested(std::size_t depth) {
  return R"({"asset":{"version":"2.0"},"extras":)" + std::string(depth, '[') +
         std::string(depth, ']') + "}";
}

std::string text_of(const TestJson& root) { return root.dump(); }

std::vector<OddFile> odd_containers() {
  const std::string good = one_triangle().glb();
  const std::size_t binary = good.size() - 8 - one_triangle().buffer.size() - 2;
  const TestJson asset = {{"version", "2.0"}};
  return {
      {"OnlySignature", "glTF", "cut within"},
      {"CutHeader", good.substr(0, 15), "cut within"},
      {"CutJson", good.substr(0, 60), "cut short"},
      {"CutBinary", good.substr(0, good.size() - 9), "cut short"},
      {"Version1", overwritten(good, 4, GltfMaker::uint32(1)), "version 1"},
      {"SizeOf4Gb", overwritten(good, 8, GltfMaker::uint32(0xFFFFFFFF)), "cut short"},
      {"SizeOf0", overwritten(good, 8, GltfMaker::uint32(0)), "without JSON"},
      {"SizeWithoutBinary", overwritten(good, 8, GltfMaker::uint32(binary)), "nowhere"},
      {"ChunkOf4Gb", overwritten(good, 12, GltfMaker::uint32(0xFFFFFFF0)), "longer than the file"},
      {"ChunkOf0", overwritten(good, 12, GltfMaker::uint32(0)), "longer than the file"},
      {"FirstChunkIsBinary", overwritten(good, 16, std::string("BIN\0", 4)), "first chunk"},
      {"BinaryChunkTooLong", overwritten(good, binary + 2, GltfMaker::uint32(0x7FFFFFFF)),
       "longer"},
      {"TrailingBytes", good + "more", "4 bytes after the end", true},
      {"JsonBroken", GltfMaker::glb_of("{\"asset\":{", ""), "goes wrong at byte"},
      {"JsonIsList", GltfMaker::glb_of("[1]", ""), "no object"},
      {"JsonIsEmpty", GltfMaker::glb_of("    ", ""), "goes wrong"},
      {"JsonNotUtf8", GltfMaker::glb_of("{\"asset\":\"\xFF\"}", ""), "goes wrong"},
      {"JsonHugeNumber", GltfMaker::glb_of("{\"asset\":1e999}", ""), "too large"},
      {"NestedDeeply", nested(10000), "in each other"},
      {"NestedDeeplyOpen", R"({"asset":)" + std::string(100000, '['), "in each other"},
      {"NoAsset", GltfMaker::glb_of("{}", ""), "no asset"},
      {"Version3", text_of({{"asset", {{"version", "3.0"}}}}), "version 3.0"},
      {"NoMeshes", text_of({{"asset", asset}}), "no triangles"},
      {"UnknownExtension", text_of({{"asset", asset}, {"extensionsRequired", {"XX_magic"}}}),
       "XX_magic"},
  };
}

std::vector<OddFile> odd_buffers() {
  const GltfMaker maker = one_triangle();
  const auto uri = [&](const std::string& text) { return maker.gltf(text); };
  constexpr std::uint64_t kHuge = ~std::uint64_t{0};
  return {
      {"NoBuffers", with("/buffers", TestJson::array()), "buffers[0]"},
      {"BufferMissing", with("/bufferViews/0/buffer", 7), "buffers[7]"},
      {"BufferNegative", with("/bufferViews/0/buffer", -1), "no whole number"},
      {"BufferNowhere", text_of(maker.root) + " ", "buffers[0]"},
      {"BufferFileMissing", uri("nothing.bin"), "not in its folder"},
      {"BufferAbove", uri("../secret.bin"), "not in its folder"},
      {"BufferAboveEncoded", uri("%2e%2e/secret.bin"), "not in its folder"},
      {"BufferAbsolute", uri("/etc/passwd"), "not in its folder"},
      {"BufferOfTheWeb", uri("https://example.org/a.bin"), "not in its folder"},
      {"BufferUriIsNumber", with("/buffers/0/uri", 3), "no text"},
      {"BufferUriHasZero", uri(std::string("a\0b", 3)), "not in its folder"},
      {"DataUriBroken", uri("data:application/octet-stream;base64,A*AA"), "broken"},
      {"DataUriWithoutData", uri("data:application/octet-stream;base64"), "broken"},
      {"DataUriShort", uri("data:;base64,AAAA"), "beyond its buffer"},
      {"ViewTooLong", with("/bufferViews/0/byteLength", 4000000000u), "beyond its buffer"},
      {"ViewOverflows", with("/bufferViews/0/byteOffset", kHuge), "beyond its buffer"},
      {"ViewLengthOverflows", with("/bufferViews/1/byteLength", kHuge), "beyond its buffer"},
      {"ViewWithoutLength", with("/bufferViews/0", {{"buffer", 0}}), "byteLength"},
      {"ViewIsNumber", with("/bufferViews/0", 5), "lacks the number"},
      {"ViewsAreObject", with("/bufferViews", {{"a", 1}}), "bufferViews["},
  };
}

std::vector<OddFile> odd_accessors() {
  constexpr std::uint64_t kHuge = ~std::uint64_t{0};
  return {
      {"CountOf4G", with("/accessors/0/count", 4294967295u), "beyond its buffer view"},
      {"CountOverflows", with("/accessors/0/count", kHuge), "beyond its buffer view"},
      {"CountIsText", with("/accessors/0/count", "3"), "no whole number"},
      {"CountIsFraction", with("/accessors/0/count", 2.5), "no whole number"},
      {"CountIsNegative", with("/accessors/0/count", -3), "no whole number"},
      {"CountTooLarge", with("/accessors/0/count", 4), "beyond its buffer view"},
      {"OffsetOutside", with("/accessors/0/byteOffset", 37), "beyond its buffer view"},
      {"OffsetOverflows", with("/accessors/0/byteOffset", kHuge), "beyond its buffer view"},
      {"StrideTooShort", with("/bufferViews/0/byteStride", 4), "stride"},
      {"StrideTooLong", with("/bufferViews/0/byteStride", 20), "beyond its buffer view"},
      {"StrideOverflows", with("/bufferViews/0/byteStride", kHuge), "beyond its buffer view"},
      {"ComponentUnknown", with("/accessors/0/componentType", 5130), "type"},
      {"ComponentHuge", with("/accessors/0/componentType", kHuge), "type"},
      {"TypeUnknown", with("/accessors/0/type", "VEC7"), "type"},
      {"PositionsAreMatrices", with("/accessors/0/type", "VEC2"), "three coordinates"},
      {"ZerosWithoutEnd",
       with("/accessors/0", {{"componentType", 5126}, {"count", 4294967295u}, {"type", "VEC3"}}),
       "no bytes"},
      {"IndicesAreReal", with("/meshes/0/primitives/0/indices", 0), "whole numbers"},
      {"IndicesMissing", with("/meshes/0/primitives/0/indices", 99), "accessors[99]"},
      {"PositionsMissing", with("/meshes/0/primitives/0/attributes/POSITION", 99), "accessors[99]"},
      {"SparseIsNumber", with("/accessors/0/sparse", 3), "lacks the number"},
      {"SparseWithoutValues", with("/accessors/0/sparse", {{"count", 1}}), "sparse"},
      {"SparseTooMany",
       with("/accessors/0/sparse", {{"count", kHuge},
                                    {"indices", {{"bufferView", 1}, {"componentType", 5123}}},
                                    {"values", {{"bufferView", 0}}}}),
       "sparse"},
      {"SparseBeyond",
       with("/accessors/0/sparse",
            {{"count", 3},
             {"indices", {{"bufferView", 1}, {"byteOffset", 2}, {"componentType", 5123}}},
             {"values", {{"bufferView", 0}}}}),
       "sparse"},
      {"SparseNotAscending",
       with("/accessors/0/sparse", {{"count", 2},
                                    {"indices", {{"bufferView", 0}, {"componentType", 5121}}},
                                    {"values", {{"bufferView", 0}}}}),
       "sparse"},
      {"AlignmentOdd", changed([](GltfMaker& maker) {
         maker.buffer = "x" + maker.buffer;
         maker.root["bufferViews"][0]["byteOffset"] = 1;
         maker.root["bufferViews"][1]["byteOffset"] = 37;
         maker.root["meshes"][0]["primitives"].push_back(
             {{"attributes", {{"POSITION", 0}}}, {"mode", 0}});
       }),
       "points or lines", true},
  };
}

std::vector<OddFile> odd_scenes() {
  const auto mesh_twice = [](GltfMaker& maker) { maker.root["scenes"][0]["nodes"] = {0, 0}; };
  return {
      {"NodeIsItsChild", with("/nodes/0/children", {0}), "reached twice"},
      {"NodesInACircle", changed([](GltfMaker& maker) {
         maker.root["nodes"] = {
             {{"children", {1}}}, {{"children", {2}}, {"mesh", 0}}, {{"children", {0}}}};
       }),
       "reached twice"},
      {"CircleWithoutScene", changed([](GltfMaker& maker) {
         maker.root.erase("scenes");
         maker.root["nodes"] = {{{"children", {1}}}, {{"children", {0}}, {"mesh", 0}}};
       }),
       "circles"},
      {"SharedChild", changed([](GltfMaker& maker) {
         maker.root["nodes"] = {{{"children", {1, 2}}}, {{"children", {2}}}, {{"mesh", 0}}};
       }),
       "reached twice"},
      {"SceneNamesNodeTwice", changed(mesh_twice), "reached twice"},
      {"SceneMissing", with("/scene", 3), "scenes[3]"},
      {"SceneNegative", with("/scene", -1), "no whole number"},
      {"NodeMissing", with("/scenes/0/nodes", {5}), "nodes[5]"},
      {"NodesAreTexts", with("/scenes/0/nodes", {"a"}), "no whole number"},
      {"ChildMissing", with("/nodes/0/children", {77}), "nodes[77]"},
      {"MeshMissing", with("/nodes/0/mesh", 3), "meshes[3]"},
      {"MatrixTooShort", with("/nodes/0/matrix", {1, 2, 3}), "16 numbers"},
      {"MatrixOfTexts", with("/nodes/0/matrix", std::vector<std::string>(16, "1")), "16 numbers"},
      {"ScaleIsNull", with("/nodes/0/scale", {1, nullptr, 1}), "3 numbers"},
      {"PrimitivesAreText", with("/meshes/0/primitives", "none"), "no triangles"},
      {"AttributesAreList", with("/meshes/0/primitives/0/attributes", {1}), "without positions"},
      {"NoPositions", with("/meshes/0/primitives/0/attributes", {{"NORMAL", 0}}),
       "without positions"},
      {"ModeUnknown", with("/meshes/0/primitives/0/mode", 7), "left out"},
      {"MaterialMissing", with("/meshes/0/primitives/0/material", 2), "materials[2]"},
      {"DracoEmpty",
       with("/meshes/0/primitives/0/extensions",
            {{"KHR_draco_mesh_compression", TestJson::object()}}),
       "no attributes"},
      {"DracoNoise",
       with("/meshes/0/primitives/0/extensions",
            {{"KHR_draco_mesh_compression",
              {{"bufferView", 0}, {"attributes", {{"POSITION", 0}}}}}}),
       "broken"},
      {"MeshoptNoise",
       with("/bufferViews/0/extensions", {{"EXT_meshopt_compression",
                                           {{"buffer", 0},
                                            {"byteLength", 36},
                                            {"byteStride", 12},
                                            {"count", 3},
                                            {"mode", "ATTRIBUTES"}}}}),
       "broken"},
      {"MeshoptOf4Gb",
       with("/bufferViews/0/extensions", {{"EXT_meshopt_compression",
                                           {{"buffer", 0},
                                            {"byteLength", 36},
                                            {"byteStride", 256},
                                            {"count", 16777216},
                                            {"mode", "ATTRIBUTES"}}}}),
       "cannot hold"},
      {"InstancesDoNotFit",
       with("/nodes/0/extensions",
            {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", 1}}}}}}),
       "fit together"},
      {"IndicesOutside", with("/accessors/0/count", 2), "corners that are not there"},
  };
}

std::vector<OddFile> odd_files() {
  std::vector<OddFile> all;
  for (const auto& list : {odd_containers(), odd_buffers(), odd_accessors(), odd_scenes()}) {
    all.insert(all.end(), list.begin(), list.end());
  }
  return all;
}

class GltfOddFiles : public ::testing::TestWithParam<OddFile> {};

TEST_P(GltfOddFiles, AreRefusedWithOneLineOrReadWithAWarning) {
  const OddFile& file = GetParam();
  for (const bool attributes : {false, true}) {
    ReadOptions options;
    options.attributes = attributes;
    std::string message;
    try {
      const ReadResult read = read_soup(std::string_view(file.bytes), "a.gltf", options);
      expect_valid_indices(read.soup);
      for (const Warning& warning : read.report.warnings) message += warning.text;
      EXPECT_TRUE(file.is_read);
    } catch (const InputError& error) {
      message = error.what();
      EXPECT_FALSE(file.is_read) << message;
    }
    EXPECT_THAT(message, HasSubstr(file.message));
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
}

INSTANTIATE_TEST_SUITE_P(All, GltfOddFiles, ::testing::ValuesIn(odd_files()),
                         [](const auto& tested) { return tested.param.name; });

TEST(GltfOddFile, NotFiniteCoordinatesAreKept) {
  const std::string bytes = changed([](GltfMaker& maker) {
    maker.buffer.replace(0, 8, bytes_of(std::vector<float>{NAN, INFINITY}));
  });
  const ReadResult read = read_text(bytes, "a");
  EXPECT_TRUE(std::isnan(read.soup.points[0].x()));
  EXPECT_EQ(read.soup.points[0].y(), INFINITY);
}

TEST(GltfOddFile, NothingOutsideTheFolderIsOpened) {
  const TemporaryFolder folder;
  const GltfMaker maker = one_triangle();
  std::filesystem::create_directory(folder.path() / "in");
  std::ofstream(folder.path() / "secret.bin", std::ios::binary) << maker.buffer;
  std::filesystem::create_symlink("../secret.bin", folder.path() / "in" / "link.bin");
  for (const std::string& uri :
       {std::string("../secret.bin"), std::string("link.bin"), std::string("x/../../secret.bin"),
        (folder.path() / "secret.bin").string()}) {
    std::ofstream(folder.path() / "in" / "a.gltf") << maker.gltf(uri);
    EXPECT_THROW((void)read_soup(folder.path() / "in" / "a.gltf"), InputError) << uri;
  }
}

TEST(GltfOddFile, ManyInstancesOfManyTrianglesTakeNoMemoryBeforeTheyAreCounted) {
  GltfMaker maker;
  maker.add_mesh(maker.add_accessor<float>(std::vector<float>(9 * 70000), "VEC3"));
  const std::size_t offsets = maker.add_accessor<float>(std::vector<float>(3 * 70000), "VEC3");
  maker.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
      offsets;
  EXPECT_THROW((void)read_text(maker.glb(), "a"), LimitError);
}

// 1.6e9 triangles, whose sides 32 bits cannot number.
TEST(GltfOddFile, MoreTrianglesThanAMeshCanHaveAreRefused) {
  GltfMaker maker;
  maker.add_mesh(maker.add_accessor<float>(std::vector<float>(9 * 40000), "VEC3"));
  const std::size_t offsets = maker.add_accessor<float>(std::vector<float>(3 * 40000), "VEC3");
  maker.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
      offsets;
  try {
    (void)read_text(maker.glb(), "a");
    FAIL();
  } catch (const LimitError& error) {
    EXPECT_STREQ(error.what(), "a: more than 1431655765 triangles");
  }
}

TEST(GltfOddFile, LooksThatAreBrokenRefuseOnlyThoseWhoWantThem) {
  const std::string bytes = with("/images", {{{"bufferView", 44}}});
  EXPECT_EQ(read_text(bytes, "a").soup.triangles.size(), 1u);
  ReadOptions options;
  options.attributes = true;
  EXPECT_THROW((void)read_soup(std::string_view(bytes), "a", options), InputError);
}

TEST(GltfOddFile, EachPointHasOneValueOfAnAttribute) {
  for (const std::string name : {"TEXCOORD_0", "COLOR_0", "NORMAL", "_OTHER"}) {
    for (const std::size_t count : {std::size_t{2}, std::size_t{4}}) {
      const std::string bytes = changed([&](GltfMaker& maker) {
        maker.root["meshes"][0]["primitives"][0]["attributes"][name] =
            maker.add_accessor<float>(std::vector<float>(3 * count, 0.5f), "VEC3");
      });
      EXPECT_EQ(read_text(bytes, "a").soup.triangles.size(), 1u);
      try {
        (void)read_soup(std::string_view(bytes), "a", {.attributes = true});
        ADD_FAILURE() << name << " " << count;
      } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()), "a: a primitive has " + std::to_string(count) +
                                                 " values of " + name + " for 3 points");
      }
    }
  }
}

TEST(GltfOddFile, BrokenAnimationsAreLeftOut) {
  const std::string bytes =
      with("/animations",
           {{{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "scale"}}}}}},
             {"samplers", {{{"input", 70}, {"output", 71}}}}}});
  ReadOptions options;
  options.attributes = true;
  const ReadResult read = read_soup(std::string_view(bytes), "a", options);
  const std::string written =
      format_soup(read.soup, SoupFormat::gltf, {.attributes = &read.attributes});
  EXPECT_EQ(written.find("animations"), std::string::npos);
}

}  // namespace
}  // namespace meshrepair
