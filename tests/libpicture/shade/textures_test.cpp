// SPDX-License-Identifier: MIT
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include <base/ids.h>
#include <picture/png_io.h>
#include <picture/textures.h>

#include "shapes.h"
#include "temporary_folder.h"
#include "textured.h"
#include "warning_texts.h"

namespace meshrepair {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string small_png() { return format_png(filled({4, 2}, {10, 20, 30, 255})); }

void write(const fs::path& path, const std::string& bytes) {
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << bytes;
}

// A cube with one material that has this picture.
Attributes with_image(Image image) {
  Attributes attributes = testing::textured({testing::cube()}).attributes;
  attributes.images = {std::move(image)};
  attributes.looks = {{{1, 1, 1, 1}, 0}};
  return attributes;
}

Attributes with_file(const fs::path& path) {
  return with_image({path.filename().string(), "", path.string(), nullptr});
}

Attributes with_bytes(const std::string& bytes) {
  return with_image({"a.png", "", "", std::make_shared<const std::string>(bytes)});
}

TEST(TexturesOfMesh, OpensFilesInTheFolderAndBelow) {
  const TemporaryFolder folder;
  write(folder.path() / "a.png", small_png());
  write(folder.path() / "maps/b.png", small_png());
  Textures textures({folder.path()});
  for (const char* name : {"a.png", "maps/b.png"}) {
    const auto found = textures.of(with_file(folder.path() / name));
    ASSERT_EQ(found.size(), 1U);
    ASSERT_NE(found[0], nullptr) << name;
    EXPECT_EQ(found[0]->size(), (PictureSize{4, 2}));
  }
  EXPECT_THAT(textures.warnings(), IsEmpty());
}

TEST(TexturesOfMesh, OpensNothingElsewhere) {
  const TemporaryFolder folder;
  write(folder.path() / "secret.png", small_png());
  fs::create_directories(folder.path() / "mesh");
  fs::create_symlink(folder.path() / "secret.png", folder.path() / "mesh/link.png");
  fs::create_directories(folder.path() / "mesh/folder.png");
  const fs::path mesh = folder.path() / "mesh";
  for (const fs::path& path : {folder.path() / "secret.png", mesh / "../secret.png",
                               mesh / "link.png", mesh / "folder.png", fs::path("/dev/zero")}) {
    Textures textures({mesh});
    EXPECT_EQ(textures.of(with_file(path))[0], nullptr) << path;
    EXPECT_THAT(texts(textures.warnings()),
                ElementsAre(HasSubstr("is not there, or not in the mesh's")));
  }
  Textures without_folder;
  EXPECT_EQ(without_folder.of(with_file(folder.path() / "secret.png"))[0], nullptr);
}

TEST(TexturesOfMesh, TakesPicturesThatAreInTheFile) {
  Textures textures;
  const Attributes attributes = with_bytes(small_png());
  const auto found = textures.of(attributes);
  ASSERT_NE(found[0], nullptr);
  EXPECT_EQ(textures.of(attributes)[0], found[0]);  // decoded once
}

TEST(TexturesOfMesh, SaysOnceWhatCannotBeRead) {
  Textures textures;
  const Attributes attributes = with_bytes("GIF89a");
  EXPECT_EQ(textures.of(attributes)[0], nullptr);
  EXPECT_EQ(textures.of(attributes)[0], nullptr);
  EXPECT_THAT(texts(textures.warnings()),
              ElementsAre("the picture 'a.png' is neither PNG nor JPEG; not drawn"));
}

TEST(TexturesOfMesh, PassesOverPicturesThatNoTriangleNeeds) {
  Textures textures;
  Attributes attributes = with_bytes("no picture");
  attributes.materials.of_triangle.assign(12, kNone);
  EXPECT_EQ(textures.of(attributes)[0], nullptr);
  attributes = with_bytes("no picture");
  attributes.corners.clear();
  EXPECT_EQ(textures.of(attributes)[0], nullptr);
  EXPECT_THAT(textures.warnings(), IsEmpty());
}

}  // namespace
}  // namespace meshrepair
