// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <fstream>
#include <gmock/gmock.h>
#include <iterator>
#include <numeric>
#include <random>
#include <string>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <gtest/gtest.h>

#include <mesh/openmesh.h>

#include "share_of_cases.h"
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

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

TEST(ReadOm, PropertiesAndPolygonsArePassedOver) {
  const TemporaryFolder folder;
  const std::string path = (folder.path() / "mesh.om").string();
  using PolyMesh = OpenMesh::PolyMesh_ArrayKernelT<>;
  PolyMesh mesh;
  mesh.request_vertex_normals();
  mesh.request_vertex_colors();
  mesh.request_face_normals();
  mesh.request_vertex_status();
  OpenMesh::VPropHandleT<double> weight;
  mesh.add_property(weight, "weight");
  mesh.property(weight).set_persistent(true);
  std::vector<PolyMesh::VertexHandle> corners;
  // Enough points for ids of two bytes.
  for (int i = 0; i < 300; ++i) {
    const auto x = static_cast<float>(std::cos(i * 0.02));
    corners.push_back(mesh.add_vertex({x, static_cast<float>(std::sin(i * 0.02)), 0}));
  }
  mesh.add_face(corners);
  OpenMesh::IO::Options options = OpenMesh::IO::Options::VertexNormal;
  options += OpenMesh::IO::Options::VertexColor;
  options += OpenMesh::IO::Options::FaceNormal;
  options += OpenMesh::IO::Options::Status;
  ASSERT_TRUE(OpenMesh::IO::write_mesh(mesh, path, options));
  const TriangleSoup soup = read_om(path);
  EXPECT_EQ(soup.points.size(), 300u);
  EXPECT_EQ(soup.triangles.size(), 298u);
}

TEST(ReadOm, CornersOfVersionOne) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "mesh.om";
  // Kind, version 1.2, counts, three points in float, chunk of faces with ids of one byte.
  const std::string head("OMP\x22\3\0\0\0\1\0\0\0\3\0\0\0\0\x16", 18);
  const std::string faces("\xE8\x02\3\0\0\1\2", 7);
  std::ofstream(path, std::ios::binary) << head + std::string(36, '\0') + faces;
  EXPECT_EQ(read_om(path).triangles, (std::vector<Triangle>{{0, 1, 2}}));
}

TEST(ReadOm, BrokenFileIsRefusedOrAValidSoup) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "mesh.om";
  ASSERT_TRUE(OpenMesh::IO::write_mesh(to_openmesh(tetrahedron()), path.string()));
  const std::string whole = bytes_of(path);
  const auto read = [&](const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
    try {
      expect_valid_indices(read_om(path));
      return true;
    } catch (const InputError&) {
      return false;
    }
  };
  EXPECT_TRUE(read(whole));
  const std::size_t faces_end = whole.size() - 2;
  for (std::size_t size = 0; size < faces_end; ++size)
    EXPECT_FALSE(read(whole.substr(0, size))) << size;
  std::mt19937 random(3);
  for (int round = 0; round < share_of_cases(1000); ++round) {
    std::string bytes = whole;
    for (unsigned count = 1 + random() % 4; count > 0; --count) {
      bytes[random() % bytes.size()] = static_cast<char>(random() % 256);
    }
    read(bytes);
  }
}

TEST(ReadOm, WhatIsNoOmIsRefused) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "mesh.om";
  EXPECT_THROW(static_cast<void>(read_om(path)), InputError);
  std::ofstream(path) << "no mesh at all, but long enough to hold a header";
  EXPECT_THROW(static_cast<void>(read_om(path)), InputError);
  std::ofstream(folder.path() / "mesh.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  EXPECT_THROW(static_cast<void>(read_om(folder.path() / "mesh.obj")), InputError);
}

}  // namespace
}  // namespace meshrepair
