#include <algorithm>
#include <cmath>
#include <fstream>
#include <gmock/gmock.h>
#include <numeric>
#include <random>
#include <string>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <gtest/gtest.h>

#include <bsp/openmesh.h>

#include "soup_fixtures.h"
#include "temporary_folder.h"

namespace meshrepair {
namespace {

using ::testing::HasSubstr;

std::string refusal_of_mesh(const TriangleSoup& soup) {
  try {
    static_cast<void>(to_openmesh(soup));
  } catch (const InputError& error) {
    return error.what();
  }
  return "not refused";
}

// Begins each triangle with its smallest corner.
std::vector<Triangle> normalized(std::vector<Triangle> triangles) {
  for (Triangle& triangle : triangles) {
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()),
                triangle.end());
  }
  return triangles;
}

TEST(OpenMesh, SoupComesBack) {
  TriangleSoup soup = tetrahedron();
  soup.points[3].z() = 1.0 + 1e-15;
  soup.points.emplace_back(7, 8, 9);
  const TriMesh mesh = to_openmesh(soup);
  EXPECT_EQ(mesh.n_edges(), 6u);
  const TriangleSoup back = from_openmesh(mesh);
  EXPECT_EQ(point_bits(back), point_bits(soup));
  EXPECT_EQ(normalized(back.triangles), normalized(soup.triangles));
}

// Faces in an order in which their surface is not a manifold until the last of them has come.
TEST(OpenMesh, OrderOfTheFacesOfAManifoldDoesNotMatter) {
  TriangleSoup soup;
  soup.points.emplace_back(0, 0, 1);
  constexpr std::uint32_t kRim = 12;
  for (std::uint32_t i = 0; i < kRim; ++i) soup.points.emplace_back(std::cos(i), std::sin(i), 0);
  std::vector<std::uint32_t> order(kRim);
  std::iota(order.begin(), order.end(), 0u);
  std::mt19937 random(5);
  for (int round = 0; round < 200; ++round) {
    std::shuffle(order.begin(), order.end(), random);
    soup.triangles.clear();
    for (const std::uint32_t i : order) soup.triangles.push_back({0, 1 + i, 1 + (i + 1) % kRim});
    EXPECT_EQ(to_openmesh(soup).n_faces(), kRim);
  }
}

TEST(OpenMesh, WhatIsNoManifoldIsRefusedWithTheFirstTriangle) {
  const std::vector<Vec3d> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0},
                                     {0, 0, 1}, {1, 1, 1}, {2, 2, 2}};
  EXPECT_THAT(refusal_of_mesh({points, {{{0, 1, 2}}, {{1, 0, 3}}, {{0, 1, 4}}}}),
              HasSubstr("triangle 2 has an edge, 0 to 1, that another triangle has"));
  EXPECT_THAT(refusal_of_mesh({points, {{{0, 1, 2}}, {{0, 1, 3}}}}),
              HasSubstr("triangle 1 has an edge"));
  EXPECT_THAT(refusal_of_mesh({points, {{{0, 1, 2}}, {{3, 3, 4}}}}),
              HasSubstr("triangle 1 has two equal corners"));
  EXPECT_THAT(refusal_of_mesh({points, {{{0, 1, 2}}, {{0, 3, 4}}}}),
              HasSubstr("triangle 1 touches triangles before it only in point 0"));
  EXPECT_THAT(refusal_of_mesh({points, {{{0, 1, 9}}}}),
              HasSubstr("triangle 0 names a point that does not exist"));
}

TEST(OpenMesh, DeletedElementsAreLeftOut) {
  TriMesh mesh = to_openmesh(tetrahedron());
  mesh.request_face_status();
  mesh.request_edge_status();
  mesh.request_vertex_status();
  mesh.delete_vertex(TriMesh::VertexHandle(1));
  const TriangleSoup soup = from_openmesh(mesh);
  EXPECT_EQ(soup.points, (std::vector<Vec3d>{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  EXPECT_EQ(normalized(soup.triangles), (std::vector<Triangle>{{0, 2, 1}}));
}

TEST(ReadOm, FileOfOpenMeshComesBack) {
  const TemporaryFolder folder;
  const std::string path = (folder.path() / "mesh.om").string();
  TriangleSoup soup = tetrahedron();
  soup.points[3].z() = 1.0 + 1e-15;
  ASSERT_TRUE(OpenMesh::IO::write_mesh(to_openmesh(soup), path));
  const TriangleSoup back = read_om(path);
  EXPECT_EQ(point_bits(back), point_bits(soup));
  EXPECT_EQ(normalized(back.triangles), normalized(soup.triangles));
}

TEST(ReadOm, WhatIsNoOmIsRefused) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "mesh.om";
  EXPECT_THROW(read_om(path), InputError);
  std::ofstream(path) << "no mesh at all, but long enough to hold a header";
  EXPECT_THROW(read_om(path), InputError);
  std::ofstream(folder.path() / "mesh.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  EXPECT_THROW(read_om(folder.path() / "mesh.obj"), InputError);
}

}  // namespace
}  // namespace meshrepair
