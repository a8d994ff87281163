// Objects of a package one by one, and the build that they come back to.
#include <string>

#include <gtest/gtest.h>

#include <mesh/soup_io.h>

#include "package_bytes.h"
#include "soup_fixtures.h"

namespace meshrepair {
namespace {

ReadResult read_by_mesh(const std::string& bytes, bool attributes) {
  ReadOptions options;
  options.by_mesh = true;
  options.attributes = attributes;
  return read_soup(std::string_view(bytes), "a.3mf", options);
}

std::string written(const ReadResult& read) {
  SoupExtras extras;
  extras.attributes = &read.attributes;
  extras.scene = &read.scene;
  return format_soup(read.soup, SoupFormat::threemf, extras);
}

void expect_same_build(const std::string& package, std::size_t meshes, std::size_t instances) {
  const TriangleSoup before = read_soup(std::string_view(package), "a.3mf").soup;
  for (const bool attributes : {false, true}) {
    const ReadResult read = read_by_mesh(package, attributes);
    EXPECT_EQ(read.scene.meshes.size(), meshes);
    EXPECT_EQ(read.scene.instances.size(), instances);
    EXPECT_EQ(read.soup.triangles.size(), 4 * meshes);
    const std::string again = written(read);
    const TriangleSoup after = read_soup(std::string_view(again), "b.3mf").soup;
    EXPECT_EQ(after.points, before.points);
    EXPECT_EQ(after.triangles, before.triangles);
    EXPECT_EQ(written(read_by_mesh(again, attributes)), again);
  }
}

TEST(ThreemfScene, ComponentsAndItemsStay) {
  const std::string move = "transform=\"1 0 0 0 1 0 0 0 1 1 0 0\"";
  const std::string scale = "transform=\"2 0 0 0 2 0 0 0 2 0 0 0\"";
  const std::string mirror = "transform=\"-1 0 0 0 1 0 0 0 1 0 100 0\"";
  expect_same_build(
      package_of(model_of(tetrahedron_object(1, "name=\"leg\"") + tetrahedron_object(7) +
                              assembly_of(8, component_of(1, move) + component_of(1)) +
                              assembly_of(9, component_of(8, scale) + component_of(7)),
                          item_of(9, mirror) + item_of(1), "unit=\"inch\"")),
      2, 4);
}

TEST(ThreemfScene, NamesAndUnitsStay) {
  const ReadResult read = read_by_mesh(
      package_of(model_of(tetrahedron_object(1, "name=\"leg\""), item_of(1), "unit=\"inch\"")),
      true);
  EXPECT_EQ(read.report.unit, LengthUnit::inch);
  EXPECT_EQ(read.scene.meshes[0].name, "leg");
  const ReadResult again = read_by_mesh(written(read), true);
  EXPECT_EQ(again.report.unit, LengthUnit::inch);
  EXPECT_EQ(again.scene.meshes[0].name, "leg");
}

TEST(ThreemfScene, MeshesThatBecameEmptyAreLeftOut) {
  ReadResult read = read_by_mesh(
      package_of(model_of(tetrahedron_object(1) + tetrahedron_object(2) +
                              assembly_of(3, component_of(1)) + assembly_of(4, component_of(2)),
                          item_of(3) + item_of(4))),
      false);
  ASSERT_EQ(read.scene.meshes.size(), 2u);
  read.scene.meshes[0] = {"", 0, 0};
  read.soup = meshes_of(read.soup, {{{"", 0, 0}, {"", 4, 4}}, {}})[1];
  const TriangleSoup after = read_soup(std::string_view(written(read)), "b.3mf").soup;
  EXPECT_EQ(after.triangles.size(), 4u);
}

}  // namespace
}  // namespace meshrepair
