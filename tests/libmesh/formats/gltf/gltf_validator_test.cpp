// SPDX-License-Identifier: MIT
// What is written passes Khronos' validator without an error.
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <string>
#include <sys/wait.h>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <mesh/soup_io.h>

#include "each_seed.h"
#include "gltf_maker.h"
#include "mixed_soups.h"
#include "package_bytes.h"
#include "share_of_cases.h"
#include "soup_fixtures.h"
#include "temporary_folder.h"

namespace meshrepair {
namespace {

namespace fs = std::filesystem;

struct Ended {
  int code;
  std::string output;
};

Ended run(const std::string& command) {
  std::FILE* const pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return {-1, "cannot be started"};
  Ended ended{0, {}};
  std::array<char, 4096> piece;
  while (const std::size_t count = std::fread(piece.data(), 1, piece.size(), pipe)) {
    ended.output.append(piece.data(), count);
  }
  const int status = ::pclose(pipe);
  ended.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return ended;
}

class WrittenFiles {
 public:
  explicit WrittenFiles(const fs::path& folder) : folder_(folder) {}

  void add(const TriangleSoup& soup, const Attributes* attributes) {
    for (const SoupFormat format : {SoupFormat::glb, SoupFormat::gltf}) {
      const std::string name =
          std::to_string(count_) + (format == SoupFormat::glb ? ".glb" : ".gltf");
      std::ofstream(folder_ / name, std::ios::binary)
          << format_soup(soup, format, {.attributes = attributes, .folder = folder_});
      ++count_;
    }
  }

  // What comes of a file in another format.
  void add_read(const std::string& bytes) {
    ReadOptions options;
    options.attributes = true;
    const ReadResult mesh = read_soup(std::string_view(bytes), "mesh", options);
    add(mesh.soup, &mesh.attributes);
  }

  [[nodiscard]] int count() const { return count_; }

 private:
  fs::path folder_;
  int count_ = 0;
};

// A scene with a camera, a light, a moving node and two pictures beside the mesh.
std::string scene(const std::string& picture) {
  GltfMaker maker;
  const std::size_t points =
      maker.add_accessor(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3");
  maker.root["accessors"][points]["min"] = {0, 0, 0};
  maker.root["accessors"][points]["max"] = {1, 1, 1};
  const std::size_t indices =
      maker.add_accessor(std::vector<std::uint16_t>{0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2}, "SCALAR");
  const std::size_t times = maker.add_accessor(std::vector<float>{0, 1}, "SCALAR");
  maker.root["accessors"][times]["min"] = {0};
  maker.root["accessors"][times]["max"] = {1};
  const std::size_t moves = maker.add_accessor(std::vector<float>{0, 0, 0, 1, 2, 3}, "VEC3");
  maker.add("images", {{"bufferView", maker.add_view(picture)}, {"mimeType", "image/png"}});
  maker.add("textures", {{"source", 0}, {"sampler", 0}});
  maker.add("samplers", {{"wrapS", 33071}});
  maker.add("materials", {{"name", "wood"},
                          {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}},
                          {"extras", {{"anything", true}}}});
  maker.add("meshes",
            {{"primitives",
              {{{"attributes", {{"POSITION", points}}}, {"indices", indices}, {"material", 0}}}}});
  maker.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}});
  maker.add("nodes", {{"mesh", 0}, {"scale", {2, 2, 2}}});
  maker.add("nodes", {{"camera", 0}, {"translation", {0, 0, 5}}});
  maker.add("animations",
            {{"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}}},
             {"samplers", {{{"input", times}, {"output", moves}}}}});
  maker.add("scenes", {{"nodes", {0, 1}}});
  maker.root["scene"] = 0;
  return maker.glb();
}

void write_all(WrittenFiles& files) {
  for_each_seed(30, [&](std::uint64_t seed) {
    const TexturedSoup soup = random_mixed_soup(seed);
    files.add(soup.soup, &soup.attributes);
  });
  for_each_seed(4, [&](std::uint64_t seed) {
    const TexturedSoup soup = random_textured_soup(seed);  // with triangles of two points
    files.add(soup.soup, &soup.attributes);
  });
  files.add(tetrahedron(), nullptr);
  files.add({}, nullptr);
  files.add(random_soup(1, true), nullptr);  // of all magnitudes
  const TexturedSoup soup = random_mixed_soup(3);
  for (const SoupFormat format : {SoupFormat::obj, SoupFormat::ply_binary, SoupFormat::threemf,
                                  SoupFormat::stl_binary, SoupFormat::glb}) {
    files.add_read(format_soup(soup.soup, format, {.attributes = &soup.attributes}));
  }
  const std::string picture = one_pixel_png(10, 20, 30);
  files.add_read(scene(picture));
  const std::string obj =
      "mtllib a.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n";
  files.add_read(
      zip_of({{"a.obj", obj}, {"a.mtl", "newmtl a\nmap_Kd b.png\n"}, {"b.png", picture}}));
}

TEST(GltfValidator, FindsNoErrorInWhatIsWritten) {
  if (run("node --version").code != 0) GTEST_SKIP() << "there is no node: scripts/setup.sh all";
  const TemporaryFolder folder;
  WrittenFiles files(folder.path());
  write_all(files);
  const Ended ended =
      run("node '" MESHREPAIR_NODE_FOLDER "/validate_gltf.mjs' '" + folder.path().string() + "'");
  if (ended.code == 77) GTEST_SKIP() << ended.output << "scripts/setup.sh all installs it";
  EXPECT_EQ(ended.code, 0) << ended.output;
  EXPECT_GE(files.count(), expected_cases(60));
  EXPECT_THAT(ended.output,
              ::testing::HasSubstr(std::to_string(files.count()) + " files, 0 errors"));
}

}  // namespace
}  // namespace meshrepair
