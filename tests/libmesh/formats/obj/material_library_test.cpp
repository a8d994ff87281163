// SPDX-License-Identifier: MIT
// Libraries of materials of OBJ files.
#include <array>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <mesh/soup_io.h>

#include "temporary_folder.h"
#include "warning_texts.h"

namespace meshrepair {
namespace {

ReadResult read_with_attributes(const std::filesystem::path& path) {
  ReadOptions options;
  options.attributes = true;
  return read_soup(path, options);
}

std::string text_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

constexpr const char* kCube = R"(mtllib lib/cube.mtl
v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 1
vt 0 0
vt 1 0
vt 0.5 1
usemtl wood
f 1/1 3/3 2/2
usemtl steel plate
f 1/1 2/2 4/3
f 2 3 4
)";

// Of a file and its library, in folders.
class ObjLibraries : public ::testing::Test {
 protected:
  ObjLibraries() {
    std::filesystem::create_directories(folder_.path() / "in/lib");
    std::filesystem::create_directories(folder_.path() / "out/deep");
    write("in/cube.obj", kCube);
    write("in/lib/cube.mtl",
          "# of cubes\nnewmtl wood\n  Kd 0.5 0.25 0.125\nd 0.5\n"
          "map_Kd -s 1 1 1 -o 0.5 textures\\wood grain.png\nbump ../secret.png\n"
          "newmtl steel plate\nmap_Bump -bm 0.5 bump.png\n");
  }
  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder_.path() / name) << text;
  }
  TemporaryFolder folder_;
};

TEST_F(ObjLibraries, SayWhatMaterialsLookLike) {
  const ReadResult result = read_with_attributes(folder_.path() / "in/cube.obj");
  EXPECT_TRUE(result.report.warnings.empty());
  ASSERT_EQ(result.attributes.looks.size(), 2u);
  const Material& wood = result.attributes.looks[0];
  EXPECT_EQ(wood.colour, (std::array<double, 4>{0.5, 0.25, 0.125, 0.5}));
  ASSERT_EQ(wood.image, 0u);
  EXPECT_EQ(result.attributes.images[0].path,
            (folder_.path() / "in/lib/textures/wood grain.png").string());
  EXPECT_EQ(result.attributes.looks[1].image, kNone);
}

TEST_F(ObjLibraries, AreWrittenBesideTheMeshWithNamesOfPicturesFromThere) {
  const ReadResult result = read_with_attributes(folder_.path() / "in/cube.obj");
  const auto out = folder_.path() / "out/deep/cube.obj";
  write_soup(result.soup, out, {.extras = {.attributes = &result.attributes}});
  EXPECT_TRUE(text_of(out).starts_with("mtllib cube.mtl\n"));
  EXPECT_EQ(
      text_of(folder_.path() / "out/deep/cube.mtl"),
      "# of cubes\nnewmtl wood\n  Kd 0.5 0.25 0.125\nd 0.5\n"
      "map_Kd -s 1 1 1 -o 0.5 ../../in/lib/textures/wood grain.png\nbump ../../in/secret.png\n"
      "newmtl steel plate\nmap_Bump -bm 0.5 ../../in/lib/bump.png\n");
}

TEST_F(ObjLibraries, LibrariesOfTheInputAreNotWrittenOver) {
  const std::string library = "newmtl wood\n";
  write("in/other.mtl", library);
  write("in/mesh.obj", "mtllib other.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl wood\nf 1 2 3\n");
  ReadResult result = read_with_attributes(folder_.path() / "in/mesh.obj");
  write_soup(result.soup, folder_.path() / "in/other.obj",
             {.extras = {.attributes = &result.attributes}});
  EXPECT_EQ(text_of(folder_.path() / "in/other.mtl"), library);
  result.attributes.materials.names[0] = "another";
  write_soup(result.soup, folder_.path() / "in/other.obj",
             {.extras = {.attributes = &result.attributes}});
  EXPECT_EQ(text_of(folder_.path() / "in/other.mtl"), library);
  EXPECT_TRUE(text_of(folder_.path() / "in/other.obj").starts_with("mtllib other_1.mtl\n"));
  EXPECT_NE(text_of(folder_.path() / "in/other_1.mtl").find("newmtl another\n"), std::string::npos);
}

TEST_F(ObjLibraries, OutsideTheFolderAreNotOpened) {
  write("secret.mtl", "newmtl wood\nKd 1 0 0\n");
  std::filesystem::create_symlink(folder_.path() / "secret.mtl", folder_.path() / "in/link.mtl");
  const std::vector<std::string> names = {
      "../secret.mtl", "lib/../../secret.mtl",
      "link.mtl",      "missing.mtl",
      "lib",           (folder_.path() / "secret.mtl").string()};
  for (const std::string& name : names) {
    write("in/mesh.obj", "mtllib " + name + "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl wood\nf 1 2 3\n");
    const ReadResult result = read_with_attributes(folder_.path() / "in/mesh.obj");
    ASSERT_EQ(result.report.warnings.size(), 1u) << name;
    EXPECT_EQ(result.attributes.looks.at(0).colour[1], 1) << name;
  }
}

// So that whoever draws it can say what is missing.
TEST_F(ObjLibraries, PicturesOutsideTheFolderKeepTheirNames) {
  write("secret.png", "picture");
  std::filesystem::create_symlink(folder_.path() / "secret.png", folder_.path() / "in/link.png");
  std::filesystem::create_directory(folder_.path() / "in/folder.png");
  for (const std::string name : {"link.png", "folder.png"}) {
    write("in/a.mtl", "newmtl wood\nmap_Kd " + name + "\n");
    write("in/mesh.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl wood\nf 1 2 3\n");
    const ReadResult result = read_with_attributes(folder_.path() / "in/mesh.obj");
    ASSERT_EQ(result.attributes.images.size(), 1u) << name;
    EXPECT_EQ(result.attributes.images[0].name, name);
    EXPECT_TRUE(result.attributes.images[0].is_elsewhere);
    EXPECT_EQ(result.attributes.images[0].bytes, nullptr);
  }
}

// Two meshes whose materials have one name: the second gets another, with all that is said of it.
TEST_F(ObjLibraries, OfTwoMeshesWithOneNameMakeTwoMaterials) {
  const std::string mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl one\nf 1 2 3\n";
  write("in/a.mtl", "newmtl one\nKd 1 0 0\n");
  write("in/b.mtl", "newmtl one\nKd 0 0 1\nNs 3\nnewmtl other\nKd 0 1 0\nNs 7\n");
  write("in/a.obj", "mtllib a.mtl\n" + mesh);
  write("in/b.obj", "mtllib b.mtl\n" + mesh);
  ReadResult both = read_with_attributes(folder_.path() / "in/a.obj");
  ReadResult second = read_with_attributes(folder_.path() / "in/b.obj");
  append_attributes(both.attributes, 1, second.attributes, 1);
  both.soup.triangles.push_back(both.soup.triangles[0]);
  const auto out = folder_.path() / "out/both.obj";
  write_soup(both.soup, out, {.extras = {.attributes = &both.attributes}});
  const ReadResult back = read_with_attributes(out);
  const TriangleLabels& materials = back.attributes.materials;
  ASSERT_EQ(materials.of_triangle.size(), 2u);
  const auto colour_of = [&](std::size_t t) {
    return back.attributes.looks.at(materials.of_triangle[t]).colour;
  };
  EXPECT_EQ(colour_of(0), (std::array<double, 4>{1, 0, 0, 1}));
  EXPECT_EQ(colour_of(1), (std::array<double, 4>{0, 0, 1, 1}));
  const std::string library = text_of(folder_.path() / "out/both.mtl");
  EXPECT_NE(library.find("newmtl other\nKd 0 1 0\nNs 7\n"), std::string::npos);
  EXPECT_EQ(library,
            "newmtl one\nKd 1 0 0\n"
            "newmtl one_2\nKd 0 0 1\nNs 3\nnewmtl other\nKd 0 1 0\nNs 7\n");
}

// A mesh of one triangle for each library: what they are joined to is written and read again.
class JoinedLibraries : public ObjLibraries {
 protected:
  // An empty text: there is no such library.
  void add(const std::string& library,
           const std::string& coordinates = "vt 0 0\nvt 1 0\nvt 0 1\n") {
    const std::string name = "m" + std::to_string(triangles_);
    if (!library.empty()) write("in/" + name + ".mtl", library);
    write("in/" + name + ".obj", (library.empty() ? std::string() : "mtllib " + name + ".mtl\n") +
                                     "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + coordinates +
                                     "usemtl one\nf 1/1 2/2 3/3\n");
    ReadResult read = read_with_attributes(folder_.path() / ("in/" + name + ".obj"));
    all_.soup.points = read.soup.points;
    append_attributes(all_.attributes, triangles_++, std::move(read.attributes), 1);
    all_.soup.triangles.push_back({0, 1, 2});
  }

  ReadResult written() {
    const auto out = folder_.path() / "out/all.obj";
    const Attributes held = held_by(SoupFormat::obj, all_.attributes);
    write_soup(all_.soup, out, {.extras = {.attributes = &held}});
    return read_with_attributes(out);
  }

  // Of the triangles, by name.
  static std::vector<std::string> materials_of(const ReadResult& read) {
    std::vector<std::string> names;
    for (const std::uint32_t material : read.attributes.materials.of_triangle) {
      names.push_back(read.attributes.materials.names.at(material));
    }
    return names;
  }

  [[nodiscard]] std::string library() const { return text_of(folder_.path() / "out/all.mtl"); }

  using Names = std::vector<std::string>;

  ReadResult all_;
  std::size_t triangles_ = 0;
};

TEST_F(JoinedLibraries, SayNothingOfAMaterialThatTheFirstDoesNotDefine) {
  add("newmtl two\nKd 0 1 0\n");
  add("newmtl one\nKd 1 1 1\nNs 3\n");
  EXPECT_EQ(materials_of(written()), (Names{"one", "one_2"}));
  EXPECT_EQ(library(),
            "newmtl two\nKd 0 1 0\nnewmtl one_2\nKd 1 1 1\nNs 3\nnewmtl one\nKd 1 1 1\n");
}

TEST_F(JoinedLibraries, SayNothingOfAMaterialThatTheSecondDoesNotDefine) {
  add("newmtl one\nKd 1 1 1\nNs 3\n");
  add("newmtl two\nKd 0 1 0\n");
  add("");
  EXPECT_EQ(materials_of(written()), (Names{"one", "one_2", "one_3"}));
}

TEST_F(JoinedLibraries, KeepAMaterialThatBothDefineAlike) {
  add("newmtl one\nKd 1 0 0\nNs 3\nmap_Kd a.png\n");
  add("# the same\nnewmtl one\n Kd 1 0 0\nNs 3\n\nmap_Kd a.png\nnewmtl two\nKd 0 1 0\n");
  EXPECT_EQ(materials_of(written()), (Names{"one", "one"}));
  EXPECT_EQ(library(),
            "newmtl one\nKd 1 0 0\nNs 3\nmap_Kd ../in/a.png\n# the same\nnewmtl two\nKd 0 1 0\n");
}

TEST_F(JoinedLibraries, TellApartWhatDiffersInMoreThanColour) {
  add("newmtl one\nKd 1 0 0\nNs 3\nnewmtl one_2\nKd 0 0 0\n");
  add("newmtl one\nKd 1 0 0\nNs 4\n");
  add("newmtl one\nKd 1 0 0\nNs 5\n");
  EXPECT_EQ(materials_of(written()), (Names{"one", "one_3", "one_4"}));
  EXPECT_NE(library().find("newmtl one_3\nKd 1 0 0\nNs 4\n"), std::string::npos);
  EXPECT_NE(library().find("newmtl one_4\nKd 1 0 0\nNs 5\n"), std::string::npos);
}

// Coordinates of two and of three numbers are two sets, of which OBJ has one.
TEST_F(JoinedLibraries, KeepCoordinatesOfEveryMesh) {
  add("newmtl two\nmap_Kd a.png\n");
  add("newmtl one\nmap_Kd a.png\n", "vt 0 0 0\nvt 0.25 0 0\nvt 0 1 0\n");
  const ReadResult back = written();
  const CornerAttribute* const places = find_kind(back.attributes, CornerAttribute::Kind::texture);
  ASSERT_NE(places, nullptr);
  ASSERT_NE(places->of_corner.at(4), kNone);
  EXPECT_EQ(places->values.at(places->components * places->of_corner[4]), 0.25);
}

TEST_F(ObjLibraries, NamesOfPicturesElsewhereStay) {
  const std::vector<std::string> names = {"C:\\tex\\y.png", "http://x.y/z.png", "../../up.png",
                                          "/tmp/root.png"};
  for (const std::string& name : names) {
    write("in/p.mtl", "newmtl wood\nmap_Kd " + name + "\n");
    write("in/p.obj", "mtllib p.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl wood\nf 1 2 3\n");
    const ReadResult read = read_with_attributes(folder_.path() / "in/p.obj");
    const WriteOptions options{.extras = {.attributes = &read.attributes}};
    write_soup(read.soup, folder_.path() / "out/deep/p.obj", options);
    EXPECT_NE(text_of(folder_.path() / "out/deep/p.mtl").find("map_Kd " + name + "\n"),
              std::string::npos);
    write_soup(read.soup, folder_.path() / "out/deep/p.gltf", options);
    const ReadResult back = read_with_attributes(folder_.path() / "out/deep/p.gltf");
    EXPECT_EQ(back.attributes.images.at(0).path, "") << name;
  }
}

TEST_F(ObjLibraries, PicturesAreFoundThroughLinksToFolders) {
  write("in/lib/grain.png", "picture");
  write("in/lib/p.mtl", "newmtl wood\nmap_Kd grain.png\n");
  write("in/p.obj", "mtllib lib/p.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl wood\nf 1 2 3\n");
  std::filesystem::create_directory_symlink(folder_.path() / "out/deep", folder_.path() / "link");
  const ReadResult read = read_with_attributes(folder_.path() / "in/p.obj");
  write_soup(read.soup, folder_.path() / "link/p.obj",
             {.extras = {.attributes = &read.attributes}});
  EXPECT_EQ(text_of(folder_.path() / "out/deep/p.mtl"),
            "newmtl wood\nmap_Kd ../../in/lib/grain.png\n");
}

TEST_F(ObjLibraries, OneLineMayNameSeveralLibraries) {
  const std::string mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl wood\nf 1 2 3\nusemtl tin\nf 1 3 2\n";
  write("in/a b.mtl", "newmtl wood\nKd 1 0 0\n");
  write("in/c.mtl", "newmtl tin\nKd 0 1 0\n");
  write("in/several.obj", "mtllib a b.mtl c.mtl\n" + mesh);
  const ReadResult read = read_with_attributes(folder_.path() / "in/several.obj");
  EXPECT_EQ(texts(read.report.warnings), std::vector<std::string>{});
  ASSERT_EQ(read.attributes.looks.size(), 2u);
  EXPECT_EQ(read.attributes.looks[0].colour[0], 1);
  EXPECT_EQ(read.attributes.looks[0].colour[1], 0);
  EXPECT_EQ(read.attributes.looks[1].colour[0], 0);
}

TEST_F(ObjLibraries, OfSeveralTheFirstThatDefinesAMaterialCountsInEveryFormat) {
  write("in/one.mtl", "newmtl wood\nKd 1 0 0\n");
  write("in/two.mtl", "newmtl wood\nKd 0 0 1\nnewmtl steel\nKd 0 1 0\n");
  write("in/two.obj",
        "mtllib one.mtl\nmtllib two.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl wood\nf 1 2 3\n"
        "usemtl steel\nf 1 3 2\n");
  const ReadResult read = read_with_attributes(folder_.path() / "in/two.obj");
  EXPECT_EQ(read.attributes.looks.at(0).colour, (std::array<double, 4>{1, 0, 0, 1}));
  EXPECT_EQ(read.attributes.looks.at(1).colour, (std::array<double, 4>{0, 1, 0, 1}));
  const auto out = folder_.path() / "out/two.obj";
  write_soup(read.soup, out, {.extras = {.attributes = &read.attributes}});
  EXPECT_EQ(read_with_attributes(out).attributes.looks.at(0).colour,
            read.attributes.looks[0].colour);
}

TEST_F(ObjLibraries, AMeshThatIsNoFileHasNone) {
  ReadOptions options;
  options.attributes = true;
  const ReadResult read = read_soup(kCube, "-", options);
  ASSERT_EQ(read.report.warnings.size(), 1u);
  EXPECT_NE(texts(read.report.warnings)[0].find("lib/cube.mtl"), std::string::npos);
}

// Else they would have the next line as a part of them.
TEST_F(ObjLibraries, NamesThatEndWithABackslashEndTheirLine) {
  write("in/b.obj", "mtllib a\\\\ \nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl wood\nf 1 2 3\n");
  const ReadResult read = read_with_attributes(folder_.path() / "in/b.obj");
  const std::string text =
      format_soup(read.soup, SoupFormat::obj, {.attributes = &read.attributes});
  EXPECT_TRUE(text.starts_with("mtllib a\\_\nv 0 0 0\n")) << text;
  EXPECT_EQ(read_soup(text, "b.obj", {}).soup.triangles.size(), 1u);
}

// '#' begins a comment only at the start of a word.
TEST_F(ObjLibraries, NamesMayHaveNumberSigns) {
  write("in/s.mtl", "newmtl Material#25\nKd 0 0 1\n");
  write("in/s.obj", "mtllib s.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl Material#25\nf 1 2 3\n");
  const ReadResult read = read_with_attributes(folder_.path() / "in/s.obj");
  EXPECT_EQ(read.attributes.materials.names, std::vector<std::string>{"Material#25"});
  for (const char* name : {"out/no #5.obj", "out/#5.obj", "out/a#5.obj", "out/a\nv 0.obj"}) {
    write_soup(read.soup, folder_.path() / name, {.extras = {.attributes = &read.attributes}});
    const ReadResult back = read_with_attributes(folder_.path() / name);
    EXPECT_EQ(texts(back.report.warnings), std::vector<std::string>{}) << name;
    EXPECT_EQ(back.attributes.materials.names, read.attributes.materials.names) << name;
    ASSERT_EQ(back.attributes.looks.size(), 1u) << name;
    EXPECT_EQ(back.attributes.looks[0].colour[0], 0) << name;
  }
}

// The library keeps the options of its maps; other formats get coordinates that have them.
TEST_F(ObjLibraries, ScaleAndOffsetOfAPictureAreKeptOnce) {
  write("in/t.mtl", "newmtl wood\nmap_Kd -s 2 3 1 -o 0.25 0.5 0 a.png\n");
  write("in/a.png", "picture");
  write("in/t.obj",
        "mtllib t.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0.5 1\n"
        "usemtl wood\nf 1/1 2/2 3/3\n");
  const ReadResult read = read_with_attributes(folder_.path() / "in/t.obj");
  const WriteOptions options{.extras = {.attributes = &read.attributes}};
  write_soup(read.soup, folder_.path() / "out/t.obj", options);
  const ReadResult same = read_with_attributes(folder_.path() / "out/t.obj");
  EXPECT_EQ(same.attributes.corners.at(0).values, read.attributes.corners.at(0).values);
  EXPECT_EQ(same.attributes.looks.at(0).transform, read.attributes.looks.at(0).transform);
  write_soup(read.soup, folder_.path() / "out/t.ply", options);
  const ReadResult moved = read_with_attributes(folder_.path() / "out/t.ply");
  const CornerAttribute& places = moved.attributes.corners.at(0);
  const std::vector<double> wanted = {0.25, 0.5, 2.25, 0.5, 1.25, 3.5};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(places.values[2 * places.of_corner[k]], wanted[2 * k]);
    EXPECT_EQ(places.values[2 * places.of_corner[k] + 1], wanted[2 * k + 1]);
  }
}

TEST_F(ObjLibraries, SayWhatOtherFormatsCannotHold) {
  const ReadResult read = read_with_attributes(folder_.path() / "in/cube.obj");
  const Keepsake& kept = *read.attributes.keepsake;
  EXPECT_EQ(kept.lost_in(SoupFormat::obj), std::vector<std::string>{});
  EXPECT_EQ(kept.lost_in(SoupFormat::glb), std::vector<std::string>{"bump map_Bump of materials"});
}

}  // namespace
}  // namespace meshrepair
