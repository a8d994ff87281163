// SPDX-License-Identifier: MIT
// What meshes of the C interface carry, into repairs and out of them, and into files.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "c_handles.h"
#include "temporary_folder.h"

namespace meshrepair::testing {
namespace {

// The number of each corner.
std::vector<std::uint32_t> each_corner(std::size_t triangles) {
  std::vector<std::uint32_t> corners(3 * triangles);
  for (std::size_t c = 0; c < corners.size(); ++c) corners[c] = static_cast<std::uint32_t>(c);
  return corners;
}

// A cube with texture coordinates of its own at each corner, and two materials.
Mesh painted_cube() {
  Mesh mesh = mesh_of(cube());
  std::vector<double> values;
  for (int c = 0; c < 36; ++c) values.insert(values.end(), {c / 64.0, 1 - c / 64.0});
  EXPECT_EQ(meshrepair_mesh_add_attribute(mesh.get(), "texture", 2, values.data(), 36,
                                          each_corner(12).data()),
            MESHREPAIR_DONE);
  std::vector<std::uint32_t> materials(12, 0);
  materials[5] = 1;
  materials[6] = MESHREPAIR_NONE;
  const std::vector<const char*> names = {"wood", "steel"};
  EXPECT_EQ(meshrepair_mesh_set_labels(mesh.get(), MESHREPAIR_MATERIAL, names.data(), names.size(),
                                       materials.data()),
            MESHREPAIR_DONE);
  return mesh;
}

void expect_painted(const meshrepair_mesh* mesh) {
  ASSERT_EQ(meshrepair_mesh_attribute_count(mesh), 1U);
  EXPECT_STREQ(meshrepair_mesh_attribute_name(mesh, 0), "texture");
  EXPECT_EQ(meshrepair_mesh_attribute_components(mesh, 0), 2U);
  EXPECT_EQ(meshrepair_mesh_attribute_value_count(mesh, 0), 36U);
  const double* const values = meshrepair_mesh_attribute_values(mesh, 0);
  const std::uint32_t* const corners = meshrepair_mesh_attribute_corners(mesh, 0);
  for (std::size_t c = 0; c < 36; ++c) {
    EXPECT_EQ(values[2 * corners[c] + 1], 1 - values[2 * corners[c]]);
  }
  ASSERT_EQ(meshrepair_mesh_label_count(mesh, MESHREPAIR_MATERIAL), 2U);
  EXPECT_STREQ(meshrepair_mesh_label_name(mesh, MESHREPAIR_MATERIAL, 1), "steel");
  const std::uint32_t* const materials = meshrepair_mesh_labels(mesh, MESHREPAIR_MATERIAL);
  EXPECT_EQ(materials[5], 1U);
  EXPECT_EQ(materials[6], MESHREPAIR_NONE);
}

TEST(CAttributes, ComeThroughARepairAndAFile) {
  const Mesh mesh = painted_cube();
  expect_painted(mesh.get());
  const Result repaired(meshrepair_repair(mesh.get(), nullptr));
  ASSERT_EQ(code_of(repaired), MESHREPAIR_DONE) << error_of(repaired);
  expect_painted(mesh_in(repaired));

  const TemporaryFolder folder;
  const std::string path = folder.path() / "cube.obj";
  const Result written(meshrepair_write(path.c_str(), mesh_in(repaired), nullptr));
  ASSERT_EQ(code_of(written), MESHREPAIR_DONE) << error_of(written);
  const Result read(meshrepair_read(path.c_str(), nullptr));
  ASSERT_EQ(code_of(read), MESHREPAIR_DONE) << error_of(read);
  expect_painted(mesh_in(read));
}

TEST(CAttributes, LabelsCanBeRemoved) {
  const Mesh mesh = painted_cube();
  EXPECT_EQ(meshrepair_mesh_set_labels(mesh.get(), MESHREPAIR_MATERIAL, nullptr, 0, nullptr),
            MESHREPAIR_DONE);
  EXPECT_EQ(meshrepair_mesh_label_count(mesh.get(), MESHREPAIR_MATERIAL), 0U);
  EXPECT_EQ(meshrepair_mesh_labels(mesh.get(), MESHREPAIR_MATERIAL), nullptr);
  EXPECT_EQ(code_of(Result(meshrepair_repair(mesh.get(), nullptr))), MESHREPAIR_DONE);
}

TEST(CAttributes, OfOneKindAreNumbered) {
  const Mesh mesh = mesh_of(cube());
  const std::vector<double> values(36 * 4, 0.5);
  const std::vector<std::uint32_t> corners = each_corner(12);
  const auto add = [&](const char* name, std::size_t components) {
    return meshrepair_mesh_add_attribute(mesh.get(), name, components, values.data(), 36,
                                         corners.data());
  };
  EXPECT_EQ(add("temperature", 1), MESHREPAIR_DONE);
  EXPECT_EQ(add("colour", 4), MESHREPAIR_DONE);
  EXPECT_EQ(add("texture", 2), MESHREPAIR_DONE);
  EXPECT_EQ(add("texture", 2), MESHREPAIR_DONE);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < meshrepair_mesh_attribute_count(mesh.get()); ++i) {
    names.emplace_back(meshrepair_mesh_attribute_name(mesh.get(), i));
  }
  EXPECT_EQ(names, (std::vector<std::string>{"texture", "texture_1", "colour", "temperature"}));
}

TEST(CAttributes, OfOneKindAreAddedInTheOrderOfTheirNumbers) {
  const Mesh mesh = mesh_of(cube());
  const std::vector<double> values(36 * 2, 0.5);
  const auto add = [&](const char* name) {
    return meshrepair_mesh_add_attribute(mesh.get(), name, 2, values.data(), 36,
                                         each_corner(12).data());
  };
  EXPECT_EQ(add("texture_1"), MESHREPAIR_USAGE);
  EXPECT_STREQ(meshrepair_last_error(), "texture_1: the next of its kind is texture");
  EXPECT_EQ(add("texture"), MESHREPAIR_DONE);
  EXPECT_EQ(add("texture_2"), MESHREPAIR_USAGE);
  EXPECT_EQ(add("texture_1"), MESHREPAIR_DONE);
  EXPECT_EQ(meshrepair_mesh_attribute_count(mesh.get()), 2U);
}

TEST(CAttributes, ThatMakeNoSenseAreRefusedAndChangeNothing) {
  const Mesh mesh = painted_cube();
  const std::vector<double> values(36 * 4, 0.5);
  std::vector<std::uint32_t> corners = each_corner(12);
  const auto add = [&](const char* name, std::size_t components, std::size_t count) {
    return meshrepair_mesh_add_attribute(mesh.get(), name, components, values.data(), count,
                                         corners.data());
  };
  EXPECT_EQ(add("texture", 4, 36), MESHREPAIR_USAGE);
  EXPECT_STREQ(meshrepair_last_error(), "texture cannot have 4 numbers a row");
  EXPECT_EQ(add("other", 0, 36), MESHREPAIR_USAGE);
  EXPECT_EQ(add("texture", 2, 35), MESHREPAIR_USAGE);
  EXPECT_STREQ(meshrepair_last_error(), "texture: number 35 is 35, but there are 35");
  EXPECT_EQ(add("", 2, 36), MESHREPAIR_USAGE);
  EXPECT_EQ(add(nullptr, 2, 36), MESHREPAIR_USAGE);
  EXPECT_EQ(add("texture", 2, static_cast<std::size_t>(-1)), MESHREPAIR_USAGE);
  const std::vector<std::uint32_t> labels(12, 1);
  const char* const name = "one";
  EXPECT_EQ(meshrepair_mesh_set_labels(mesh.get(), MESHREPAIR_GROUP, &name, 1, labels.data()),
            MESHREPAIR_USAGE);
  EXPECT_EQ(meshrepair_mesh_set_labels(mesh.get(), 9, &name, 1, labels.data()), MESHREPAIR_USAGE);
  EXPECT_EQ(meshrepair_mesh_set_labels(mesh.get(), MESHREPAIR_GROUP, nullptr, 1, labels.data()),
            MESHREPAIR_USAGE);
  EXPECT_EQ(meshrepair_mesh_set_labels(mesh.get(), MESHREPAIR_GROUP, &name, 1, nullptr),
            MESHREPAIR_USAGE);
  EXPECT_EQ(meshrepair_mesh_set_labels(nullptr, MESHREPAIR_GROUP, &name, 1, labels.data()),
            MESHREPAIR_USAGE);
  expect_painted(mesh.get());
}

}  // namespace
}  // namespace meshrepair::testing
