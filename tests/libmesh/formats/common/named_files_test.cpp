// SPDX-License-Identifier: MIT
// Where names in files may lead, and which of them are reported.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <base/error.h>
#include <mesh/named_files.h>
#include <mesh/soup_io.h>

#include "temporary_folder.h"

namespace meshrepair {
namespace {

using Names = std::vector<std::string>;

TEST(NamedFiles, StayWithinWhatIsTrusted) {
  for (const char* name : {"a", "./a", "b/../a", "b/a", "c:a", "..a", "b/..."}) {
    EXPECT_TRUE(stays_within(name)) << name;
  }
  for (const char* name : {"", "..", "../a", "b/../../a", "/a", "C:/a", "C:\\a", "https://a/b"}) {
    EXPECT_FALSE(stays_within(name)) << name;
  }
  EXPECT_TRUE(stays_within("../a", 1));
  EXPECT_TRUE(stays_within("../../b/../a", 2));
  EXPECT_FALSE(stays_within("../../a", 1));
  EXPECT_FALSE(stays_within("b/../../../a", 1));
  EXPECT_FALSE(stays_within("/a", 9));
  EXPECT_FALSE(stays_within(std::string("a\0b", 3), 9));
}

TEST(NamedFiles, LevelsAreCountedBetweenFoldersHoweverTheseAreNamed) {
  EXPECT_EQ(levels_below("a", "a/b/c"), 2u);
  EXPECT_EQ(levels_below("a/", "a/b/../b//c/."), 2u);
  EXPECT_EQ(levels_below("a", "a"), 0u);
  EXPECT_EQ(levels_below("a", "b"), 0u);
  EXPECT_EQ(levels_below("a/b", "a"), 0u);
  EXPECT_EQ(levels_below(".", "a"), 1u);
  EXPECT_EQ(levels_below(std::filesystem::current_path().parent_path(), ""), 1u);
}

// A folder with files in it, and meshes in a folder of that.
class NamedFilesOfMeshes : public ::testing::Test {
 protected:
  NamedFilesOfMeshes() {
    std::filesystem::create_directories(folder_.path() / "in/sub/deep");
    write("in/shared.mtl", "newmtl wood\nKd 1 0 0\nmap_Kd wood.png\nmap_Bump ../far.png\n");
    write("in/wood.png", "picture");
    write("secret.mtl", "newmtl wood\nKd 0 1 0\n");
  }
  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder_.path() / name) << text;
  }
  ReadResult read(const std::string& name, const std::string& within) {
    ReadOptions options;
    options.attributes = true;
    options.within = within.empty() ? std::filesystem::path() : folder_.path() / within;
    return read_soup(folder_.path() / name, options);
  }
  // An OBJ file that names this library.
  void write_painted(const std::string& name, const std::string& library) {
    write(name, "mtllib " + library + "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl wood\nf 1 2 3\n");
  }
  TemporaryFolder folder_;
};

TEST_F(NamedFilesOfMeshes, AreReadFromTheFolderThatIsTrustedAndReported) {
  write_painted("in/sub/a.obj", "../shared.mtl");
  const ReadResult alone = read("in/sub/a.obj", "");
  EXPECT_EQ(alone.report.names.files, Names{});
  EXPECT_EQ(alone.report.names.outside, Names{"../shared.mtl"});
  EXPECT_EQ(alone.report.warnings.size(), 1u);
  const ReadResult trusted = read("in/sub/a.obj", "in");
  EXPECT_EQ(trusted.report.names.files, Names{"../shared.mtl"});
  EXPECT_EQ(trusted.report.names.pictures, Names{"../wood.png"});
  EXPECT_EQ(trusted.report.names.outside, Names{"../../far.png"});
  EXPECT_TRUE(trusted.report.warnings.empty());
  EXPECT_EQ(trusted.attributes.looks.at(0).colour[0], 1);
  EXPECT_EQ(trusted.attributes.images.at(0).path, (folder_.path() / "in/wood.png").string());
}

TEST_F(NamedFilesOfMeshes, NamesOfPicturesAreRightWhereTheyAreWanted) {
  write_painted("in/sub/a.obj", "../shared.mtl");
  const ReadResult result = read("in/sub/a.obj", "in");
  std::filesystem::create_directories(folder_.path() / "out/sub");
  WriteOptions options{.extras = {.attributes = &result.attributes}};
  const auto library = [&] {
    write_soup(result.soup, folder_.path() / "out/sub/a.obj", options);
    std::ifstream file(folder_.path() / "out/sub/a.mtl");
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  const std::string head = "newmtl wood\nKd 1 0 0\nmap_Kd ", bump = "\nmap_Bump ../far.png\n";
  EXPECT_EQ(library(), head + "../../in/wood.png" + bump);
  options.names_from = folder_.path() / "in/sub";
  EXPECT_EQ(library(), head + "../wood.png" + bump);
}

TEST_F(NamedFilesOfMeshes, NoLinkLeadsOutOfTheFolderThatIsTrusted) {
  std::filesystem::create_symlink("../secret.mtl", folder_.path() / "in/link.mtl");
  write_painted("in/sub/a.obj", "../link.mtl");
  EXPECT_EQ(read("in/sub/a.obj", "in").attributes.looks.at(0).colour[1], 1);
  EXPECT_EQ(read("in/sub/a.obj", "in").report.warnings.size(), 1u);
  write_painted("in/sub/b.obj", "../../secret.mtl");
  EXPECT_EQ(read("in/sub/b.obj", "in").report.names.outside, Names{"../../secret.mtl"});
  EXPECT_EQ(read("in/sub/b.obj", "in").report.warnings.size(), 1u);
  EXPECT_EQ(read("in/sub/b.obj", "in/sub/deep").report.warnings.size(), 1u);  // it lies elsewhere
  EXPECT_TRUE(read("in/sub/b.obj", ".").report.warnings.empty());
}

TEST_F(NamedFilesOfMeshes, NamesOfOtherMachinesAreUnderstood) {
  std::filesystem::create_directories(folder_.path() / "in/Tex");
  write("in/Tex/Oak.PNG", "picture");
  write("in/Wood.MTL",
        "\xEF\xBB\xBFnewmtl wood\r\nmap_Kd \"tex\\OAK.png\"\r\nmap_Bump -bm 1 TEX/oak.png\r\n");
  for (const char* name : {"wood.mtl", "Wood.MTL", "\"Wood.mtl\"", ".\\WOOD.mtl"}) {
    write_painted("in/a.obj", name);
    const ReadResult result = read("in/a.obj", "");
    EXPECT_TRUE(result.report.warnings.empty()) << name;
    EXPECT_EQ(result.report.names.files, Names{"Wood.MTL"});
    EXPECT_EQ(result.report.names.pictures, Names{"Tex/Oak.PNG"});
    EXPECT_EQ(result.attributes.images.at(0).path, (folder_.path() / "in/Tex/Oak.PNG").string());
    write_soup(result.soup, folder_.path() / "a.obj",
               {.extras = {.attributes = &result.attributes}});
    std::ifstream file(folder_.path() / "a.mtl");
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}),
              "newmtl wood\r\nmap_Kd in/Tex/Oak.PNG\nmap_Bump -bm 1 in/Tex/Oak.PNG\n");
  }
}

TEST_F(NamedFilesOfMeshes, SeveralThatDifferInCaseAreNotGuessedAt) {
  write("in/oak.png", "one");
  write("in/OAK.png", "other");
  const MeshSource source{{}, "a.obj", {}, folder_.path() / "in"};
  EXPECT_EQ(name_as_found(source, "Oak.png"), "Oak.png");
  EXPECT_EQ(name_as_found(source, "OAK.png"), "OAK.png");
  EXPECT_EQ(name_as_found(source, "..\\secret.MTL"), "..\\secret.MTL");
  EXPECT_EQ(name_as_found(source, "SUB\\..\\Shared.mtl"), "shared.mtl");
  EXPECT_TRUE(has_named(source, "SHARED.mtl"));
  EXPECT_FALSE(has_named(source, "Oak.png"));
}

// 3MF would hold them.
TEST_F(NamedFilesOfMeshes, PicturesBehindLinksThatLeadOutAreNotOpened) {
  write("secret.png", "\x89PNG\r\n\x1A\n");
  std::filesystem::create_directory_symlink("..", folder_.path() / "in/up");
  const std::string tail =
      "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
      "property list uchar int vertex_indices\nproperty list uchar float texcoord\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 6 0 0 1 0 0 1\n";
  const auto package = [&](const std::string& picture) {
    write("in/a.ply", "ply\nformat ascii 1.0\ncomment TextureFile " + picture + "\n" + tail);
    const ReadResult result = read("in/a.ply", "");
    return format_soup(result.soup, SoupFormat::threemf, {.attributes = &result.attributes});
  };
  EXPECT_EQ(package("up/secret.png").find("Textures/"), std::string::npos);
  std::filesystem::copy_file(folder_.path() / "secret.png", folder_.path() / "in/own.png");
  EXPECT_NE(package("own.png").find("Textures/"), std::string::npos);
}

TEST_F(NamedFilesOfMeshes, BuffersAreAmongThem) {
  write("in/sub/a.gltf",
        R"({"asset":{"version":"2.0"},"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
        R"("nodes":[{"mesh":0}],"buffers":[{"uri":"../a.bin","byteLength":36}],"bufferViews":)"
        R"([{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,"componentType":5126,)"
        R"("count":3,"type":"VEC3"}],"images":[{"uri":"../wood.png"}]})");
  write("in/a.bin", std::string("\0\0\0\0\0\0\0\0\0\0\0\0\0\0\x80\x3f\0\0\0\0\0\0\0\0"
                                "\0\0\0\0\0\0\x80\x3f\0\0\0\0",
                                36));
  EXPECT_THROW((void)read("in/sub/a.gltf", ""), InputError);
  const ReadResult result = read("in/sub/a.gltf", "in");
  EXPECT_EQ(result.soup.triangles.size(), 1u);
  EXPECT_EQ(result.report.names.files, Names{"../a.bin"});
  EXPECT_EQ(result.report.names.pictures, Names{"../wood.png"});
}

}  // namespace
}  // namespace meshrepair
