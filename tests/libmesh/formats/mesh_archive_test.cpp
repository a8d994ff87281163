// SPDX-License-Identifier: MIT
// What a mesh names lies beside it: beside the packed file, or in the archive.
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <string>

#include <gtest/gtest.h>

#include <base/error.h>
#include <base/file_bytes.h>
#include <mesh/soup_io.h>

#include "packed_bytes.h"
#include "soup_fixtures.h"
#include "temporary_folder.h"
#include "warning_texts.h"

namespace meshrepair {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string kPicture = "\x89PNG\r\n\x1A\nwood";
const std::string kBumps = "\xFF\xD8\xFF bumps";

const std::string kObj =
    "mtllib part.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl wood\n"
    "f 1/1 3/2 2/3\nf 1/1 2/2 4/3\nf 2/1 3/2 4/3\nf 1/1 4/2 3/3\n";

std::string library(const std::string& prefix) {
  return "newmtl wood\nKd 1 .5 .25\nmap_Kd " + prefix + "wood.png\nbump -bm 2 " + prefix +
         "bumps.jpg\nmap_Ks " + prefix + "missing.png\n";
}

void write(const fs::path& path, const std::string& bytes) {
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << bytes;
}

std::string text_of(const fs::path& path) { return std::string(FileBytes(path).bytes()); }

ReadResult read_all(const fs::path& path) {
  ReadOptions options;
  options.attributes = true;
  return read_soup(path, options);
}

TEST(PackedMesh, NamesFilesBesideThePackedOne) {
  const TemporaryFolder folder;
  write(folder.path() / "part.obj.gz", gzip_of(kObj));
  write(folder.path() / "part.mtl", library("textures/"));
  const Attributes attributes = read_all(folder.path() / "part.obj.gz").attributes;
  ASSERT_EQ(attributes.looks.size(), 1u);
  EXPECT_EQ(attributes.looks[0].colour[1], 0.5);
  EXPECT_EQ(attributes.images.at(0).path, folder.path() / "textures/wood.png");
}

TEST(PackedMesh, IsWrittenBesideItsLibrary) {
  const TemporaryFolder folder;
  write(folder.path() / "part.obj", kObj);
  write(folder.path() / "part.mtl", library(""));
  const ReadResult mesh = read_all(folder.path() / "part.obj");
  for (const char* name : {"new.obj.gz", "new.obj.zst"}) {
    write_soup(mesh.soup, folder.path() / name, {.extras = {.attributes = &mesh.attributes}});
    EXPECT_THAT(text_of(folder.path() / "new.mtl"), HasSubstr("newmtl wood\nKd 1 .5 .25\n"));
    const ReadResult back = read_all(folder.path() / name);
    EXPECT_THAT(back.report.warnings, IsEmpty());
    EXPECT_EQ(back.attributes.looks.at(0).colour[1], 0.5);
    EXPECT_EQ(back.attributes.images.at(0).path, folder.path() / "wood.png");
  }
  // Two meshes and their library, and what was there.
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 5);
}

// As the large exchanges of models pack them.
std::string archive() {
  return zip_of({{"source/part.obj", kObj},
                 {"source/part.mtl", library("../textures/")},
                 {"textures/Wood.png", kPicture},
                 {"textures/bumps.jpg", kBumps},
                 {"other.mtl", "newmtl wood\nKd 0 0 0\n"}});
}

TEST(MeshArchive, HasTheLibraryAndThePictures) {
  const TemporaryFolder folder;
  write(folder.path() / "part.zip", archive());
  const ReadResult mesh = read_all(folder.path() / "part.zip");
  EXPECT_THAT(mesh.report.warnings, IsEmpty());
  EXPECT_EQ(mesh.report.packed.entry, "source/part.obj");
  EXPECT_EQ(mesh.attributes.looks.at(0).colour[2], 0.25);
  ASSERT_EQ(mesh.attributes.images.size(), 1u);
  EXPECT_EQ(*mesh.attributes.images[0].bytes, kPicture);
  EXPECT_EQ(mesh.attributes.images[0].path, "");
  EXPECT_EQ(mesh.attributes.images[0].name, "wood.png");
}

TEST(MeshArchive, GivesPicturesToAnObjFile) {
  const TemporaryFolder out;
  const std::string bytes = archive();
  ReadOptions options;
  options.attributes = true;
  const ReadResult mesh = read_soup(std::string_view(bytes), "standard input", options);
  write_soup(mesh.soup, out.path() / "new.obj", {.extras = {.attributes = &mesh.attributes}});
  EXPECT_EQ(text_of(out.path() / "new.mtl"),
            "newmtl wood\nKd 1 .5 .25\nmap_Kd new_0.png\nbump -bm 2 new_1.jpg\n"
            "map_Ks ../textures/missing.png\n");
  EXPECT_EQ(text_of(out.path() / "new_0.png"), kPicture);
  EXPECT_EQ(text_of(out.path() / "new_1.jpg"), kBumps);
  const Attributes back = read_all(out.path() / "new.obj").attributes;
  EXPECT_EQ(back.images.at(0).path, out.path() / "new_0.png");
}

TEST(MeshArchive, GivesPicturesToOtherFormats) {
  const TemporaryFolder folder, out;
  write(folder.path() / "part.zip", archive());
  const ReadResult mesh = read_all(folder.path() / "part.zip");
  for (const char* name : {"new.glb", "new.gltf", "new.3mf"}) {
    SCOPED_TRACE(name);
    write_soup(mesh.soup, out.path() / name, {.extras = {.attributes = &mesh.attributes}});
    const Attributes back = read_all(out.path() / name).attributes;
    ASSERT_EQ(back.images.size(), 1u);
    EXPECT_EQ(*back.images[0].bytes, kPicture);
  }
}

TEST(MeshArchive, HasFilesThatAreNamedAsWindowsDoes) {
  const std::string bytes = zip_of({{"a/part.obj", replaced(kObj, "part.mtl", "\"Lib\\PART.mtl\"")},
                                    {"a/lib/part.mtl",
                                     "newmtl wood\nKd 0 .5 0\nmap_Kd \"..\\Tex\\Wood.png\"\n"
                                     "bump \"..\\bumps.JPG\"\n"},
                                    {"a/bumps.jpg", kBumps},
                                    {"a/tex/wood.png", kPicture}});
  ReadOptions options;
  options.attributes = true;
  const ReadResult mesh = read_soup(std::string_view(bytes), "a.zip", options);
  EXPECT_THAT(mesh.report.warnings, IsEmpty());
  EXPECT_EQ(mesh.attributes.looks.at(0).colour[1], 0.5);
  ASSERT_EQ(mesh.attributes.images.size(), 1u);
  EXPECT_EQ(*mesh.attributes.images[0].bytes, kPicture);
  const TemporaryFolder out;
  write_soup(mesh.soup, out.path() / "new.obj", {.extras = {.attributes = &mesh.attributes}});
  EXPECT_EQ(text_of(out.path() / "new.mtl"),
            "newmtl wood\nKd 0 .5 0\nmap_Kd new_0.png\nbump new_1.JPG\n");
  EXPECT_EQ(text_of(out.path() / "new_1.JPG"), kBumps);
}

TEST(MeshArchive, SaysWhichLibraryIsNotThere) {
  const std::string bytes = zip_of({{"a/part.obj", kObj}, {"part.mtl", library("")}});
  ReadOptions options;
  options.attributes = true;
  const ReadResult mesh = read_soup(std::string_view(bytes), "a.zip", options);
  EXPECT_THAT(texts(mesh.report.warnings),
              ::testing::ElementsAre("the library of materials part.mtl is not in its archive"));
}

TEST(MeshArchive, DoesNotLookForFilesElsewhere) {
  const TemporaryFolder folder;
  write(folder.path() / "part.mtl", library(""));
  write(folder.path() / "part.zip",
        zip_of({{"part.obj", replaced(kObj, "part.mtl", "../../part.mtl")}}));
  const ReadResult mesh = read_all(folder.path() / "part.zip");
  EXPECT_EQ(mesh.report.warnings.size(), 1u);
  EXPECT_THAT(mesh.attributes.images, IsEmpty());
}

std::string gltf_text(const std::string& buffer) {
  return R"({"asset":{"version":"2.0"},"buffers":[{"uri":")" + buffer +
         R"(","byteLength":36}],"bufferViews":[{"buffer":0,"byteLength":36}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
"images":[{"uri":"textures/a%20b.png"}],"textures":[{"source":0}],
"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],"nodes":[{"mesh":0}],
"scenes":[{"nodes":[0]}],"scene":0})";
}

std::string triangle_bytes() {
  const std::string one = "\0\0\x80\x3F", zero(4, '\0');
  return zero + zero + zero + std::string("\0\0\x80\x3F", 4) + zero + zero + zero +
         std::string("\0\0\x80\x3F", 4) + zero;
}

TEST(MeshArchive, HasTheBuffersAndPicturesOfGltf) {
  const TemporaryFolder out;
  const std::string bytes = zip_of({{"scene.gltf", gltf_text("data/scene.bin")},
                                    {"data/scene.bin", triangle_bytes()},
                                    {"textures/a b.png", kPicture},
                                    {"license.txt", "free"}});
  ReadOptions options;
  options.attributes = true;
  const ReadResult mesh = read_soup(std::string_view(bytes), "a.zip", options);
  ASSERT_EQ(mesh.soup.triangles.size(), 1u);
  for (const char* name : {"new.glb", "new.gltf.zst"}) {
    write_soup(mesh.soup, out.path() / name, {.extras = {.attributes = &mesh.attributes}});
    const Attributes back = read_all(out.path() / name).attributes;
    ASSERT_EQ(back.images.size(), 1u);
    EXPECT_EQ(*back.images[0].bytes, kPicture);
    EXPECT_EQ(back.images[0].media_type, "image/png");
  }
}

TEST(MeshArchive, HasBuffersThatAreNamedAsWindowsDoes) {
  const std::string bytes = zip_of(
      {{"scene.gltf", gltf_text("Data\\\\scene.BIN")}, {"data/scene.bin", triangle_bytes()}});
  EXPECT_EQ(read_soup(std::string_view(bytes), "a.zip").soup.triangles.size(), 1u);
}

TEST(MeshArchive, RefusesGltfWhoseBufferIsNotThere) {
  EXPECT_EQ(refusal_of(zip_of({{"a/scene.gltf", gltf_text("scene.bin")}}), "a.zip"),
            "a.zip: a/scene.gltf: its buffer 0, scene.bin, is not in its archive");
}

TEST(MeshArchive, PlyHasItsTexture) {
  std::string ply = "ply\nformat ascii 1.0\ncomment TextureFile wood.png\nelement vertex 3\n";
  for (const char* name : {"x", "y", "z", "s", "t"})
    ply += std::string("property float ") + name + "\n";
  ply += "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  ply += "0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n";
  const std::string bytes = zip_of({{"part.ply", ply}, {"wood.png", kPicture}});
  ReadOptions options;
  options.attributes = true;
  const ReadResult mesh = read_soup(std::string_view(bytes), "a.zip", options);
  EXPECT_EQ(*mesh.attributes.images.at(0).bytes, kPicture);
}

}  // namespace
}  // namespace meshrepair
