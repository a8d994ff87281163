// SPDX-License-Identifier: MIT
// Meshes one by one.
#include <algorithm>
#include <gmock/gmock.h>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <mesh/length_unit.h>
#include <mesh/placement.h>
#include <mesh/scene.h>
#include <mesh/soup_io.h>

#include "each_seed.h"
#include "soup_fixtures.h"

namespace meshrepair {
namespace {

using ::testing::ElementsAre;

// Coordinates and a label of each triangle, in any order.
std::vector<std::string> triangles_in_words(const TriangleSoup& soup,
                                            const Attributes& attributes) {
  std::vector<std::string> words;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    std::ostringstream word;
    for (const std::uint32_t corner : soup.triangles[t]) {
      word << soup.points[corner].transpose() << ';';
    }
    const std::uint32_t object = attributes.objects.of_triangle[t];
    word << (object == kNone ? "none" : attributes.objects.names[object]) << ' '
         << attributes.corners[0].of_corner[3 * t];
    words.push_back(word.str());
  }
  std::sort(words.begin(), words.end());
  return words;
}

TEST(Scene, ObjectsBecomeMeshesWithPointsOfTheirOwn) {
  for_each_seed(50, [&](std::uint64_t seed) {
    std::mt19937 random(seed);
    TriangleSoup soup;
    Attributes attributes;
    attributes.objects.names = {"a", "b", "never", "c"};
    attributes.corners.emplace_back();
    for (int i = 0; i < 12; ++i) soup.points.emplace_back(i, i * i, i % 3);
    const auto count = static_cast<std::uint32_t>(random() % 30);
    for (std::uint32_t t = 0; t < count; ++t) {
      const auto any = [&] { return static_cast<std::uint32_t>(random() % 12); };
      soup.triangles.push_back({any(), any(), any()});
      const auto object = static_cast<std::uint32_t>(random() % 4);
      attributes.objects.of_triangle.push_back(object == 2 ? kNone : object);
      for (int k = 0; k < 3; ++k) attributes.corners[0].of_corner.push_back(t);
    }
    const std::vector<std::string> before = triangles_in_words(soup, attributes);
    const Scene scene = split_objects(soup, attributes);
    EXPECT_EQ(triangles_in_words(soup, attributes), before) << seed;
    EXPECT_TRUE(is_plain(scene));
    std::size_t triangles = 0, points = 0;
    for (const SceneMesh& mesh : scene.meshes) {
      for (std::size_t i = 0; i < mesh.triangles; ++i) {
        const auto& corners = soup.triangles[triangles + i];
        for (const std::uint32_t corner : corners) {
          EXPECT_TRUE(corner >= points && corner < points + mesh.points) << seed;
        }
      }
      triangles += mesh.triangles;
      points += mesh.points;
    }
    EXPECT_EQ(triangles, soup.triangles.size());
    EXPECT_EQ(points, soup.points.size());
    EXPECT_EQ(meshes_of(soup, scene).size(), scene.meshes.size());
  });
}

TEST(Scene, ObjectsOfAnObjFileAreReadOneByOne) {
  const std::string text =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\no first\nf 1 2 3\no second\nf 1 2 4\no first\nf 1 3 4\n";
  for (const bool attributes : {false, true}) {
    ReadOptions options;
    options.by_mesh = true;
    options.attributes = attributes;
    const ReadResult result = read_soup(std::string_view(text), "a.obj", options);
    ASSERT_EQ(result.scene.meshes.size(), 2u);
    EXPECT_EQ(result.scene.meshes[0].name, "first");
    EXPECT_EQ(result.scene.meshes[0].triangles, 2u);
    EXPECT_EQ(result.scene.meshes[0].points, 4u);
    EXPECT_EQ(result.scene.meshes[1].name, "second");
    EXPECT_EQ(result.scene.meshes[1].points, 3u);
    EXPECT_THAT(result.attributes.objects.names, ElementsAre("first", "second"));
  }
}

TEST(Scene, FormatsWithoutObjectsAreOneMesh) {
  const std::string bytes = format_soup(tetrahedron(), SoupFormat::stl_binary);
  ReadOptions options;
  options.by_mesh = true;
  const ReadResult result = read_soup(std::string_view(bytes), "a.stl", options);
  ASSERT_EQ(result.scene.meshes.size(), 1u);
  EXPECT_EQ(result.scene.meshes[0].triangles, 4u);
  EXPECT_EQ(result.soup.points, read_soup(std::string_view(bytes), "a.stl").soup.points);
  EXPECT_TRUE(is_plain(result.scene));
}

TEST(Placement, PlacementsCompose) {
  Placement turn, move;
  turn.linear << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  move.offset = Vec3d(1, 2, 3);
  EXPECT_EQ(turn.then(move).of({1, 0, 0}), Vec3d(1, 3, 3));
  EXPECT_EQ(move.then(turn).of({1, 0, 0}), Vec3d(-2, 2, 3));
  EXPECT_TRUE(Placement().is_identity());
  EXPECT_FALSE(move.is_identity());
  EXPECT_FALSE(turn.mirrors());
  turn.linear(2, 2) = -1;
  EXPECT_TRUE(turn.mirrors());
}

TEST(LengthUnit, NamesComeBack) {
  for (const LengthUnit unit : {LengthUnit::micron, LengthUnit::millimeter, LengthUnit::centimeter,
                                LengthUnit::inch, LengthUnit::foot, LengthUnit::meter}) {
    EXPECT_EQ(unit_named(unit_name(unit)), unit);
  }
  EXPECT_EQ(unit_named("yard"), std::nullopt);
  EXPECT_EQ(millimeters(LengthUnit::inch), 25.4);
}

}  // namespace
}  // namespace meshrepair
