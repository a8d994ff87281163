// SPDX-License-Identifier: MIT
#include <string>

#include <gtest/gtest.h>

#include <base/error.h>
#include <mesh/point_io.h>

namespace meshrepair {
namespace {

const std::vector<Vec3d> kTwo = {{1, 2, 3}, {4, 5, 6}};

PointReadResult read(const std::string& bytes, const std::string& name) {
  return read_points(std::string_view(bytes), name, {.colours = true});
}

std::string failure_of(const std::string& bytes, const std::string& name) {
  try {
    (void)read(bytes, name);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no failure";
}

std::string ply(const std::string& elements, const std::string& body) {
  return "ply\nformat ascii 1.0\n" + elements + "end_header\n" + body;
}

const std::string kVertices = "element vertex 2\nproperty float x\nproperty float y\n";

TEST(PlyPoints, HaveNormalsAndColours) {
  const PointReadResult result =
      read(ply(kVertices + "property float z\nproperty float nx\nproperty float ny\n"
                           "property float nz\nproperty uchar red\nproperty uchar green\n"
                           "property uchar blue\n",
               "1 2 3 0 0 1 10 20 30\n4 5 6 0 1 0 40 50 60\n"),
           "a.ply");
  EXPECT_EQ(result.cloud.points, kTwo);
  EXPECT_EQ(result.cloud.normals, (std::vector<Vec3d>{{0, 0, 1}, {0, 1, 0}}));
  EXPECT_EQ(result.cloud.colours[1], (std::array<std::uint8_t, 3>{40, 50, 60}));
}

TEST(PlyPoints, MayStandBehindOtherElementsAndListsAndBeFewerThanPromised) {
  const PointReadResult result =
      read(ply("element junk 2\nproperty list uchar int a\n" + kVertices +
                   "property list uchar int b\nproperty float z\nelement face 0\n"
                   "property list uchar int vertex_indices\n",
               "2 7 7\n0\n1 2 1 9 3\n4 5 0 6\n"),
           "a.ply");
  EXPECT_EQ(result.cloud.points, kTwo);
  const PointReadResult cut =
      read(ply("element vertex 99999999999\nproperty float x\nproperty float y\nproperty float z\n",
               "1 2 3\n4 5 6\n"),
           "a.ply");
  EXPECT_EQ(cut.cloud.points, kTwo);
  EXPECT_EQ(cut.report.missing_points, 99999999997U);
}

TEST(PlyPoints, OfABinaryFileEndWhereItEnds) {
  const std::string head =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\n"
      "property uchar x\nproperty uchar y\nproperty uchar z\nend_header\n";
  const PointReadResult result = read(head + "\1\2\3\4\5\6\7", "a.ply");
  EXPECT_EQ(result.cloud.points, kTwo);
  EXPECT_EQ(result.report.missing_points, 1U);
}

TEST(PlyPoints, WithoutCoordinatesAreRefused) {
  EXPECT_EQ(failure_of(ply("element vertex 1\nproperty float x\n", "1\n"), "a.ply"),
            "a.ply: the vertices of the PLY file have no x, y and z");
  EXPECT_EQ(failure_of(ply("element face 1\nproperty list uchar int i\n", "0\n"), "a.ply"),
            "a.ply: the PLY file has no vertices that can be read");
}

TEST(ObjPoints, HaveAsManyNormalsOrNone) {
  const PointReadResult result =
      read("v 1 2 3 1 0 0.5\nvn 0 0 1\nv 4 5 6 0 0 0\nvn 0 1 0\n", "a.obj");
  EXPECT_EQ(result.cloud.points, kTwo);
  EXPECT_EQ(result.cloud.normals.size(), 2U);
  EXPECT_EQ(result.cloud.colours[0], (std::array<std::uint8_t, 3>{255, 0, 128}));
  EXPECT_TRUE(read("v 1 2 3\nv 4 5 6\nvn 0 0 1\n", "a.obj").cloud.normals.empty());
}

TEST(ObjPoints, BadOnesTakeTheirNormalsAlong) {
  const PointReadResult result =
      read("v 1 2 3\nv x\nv 4 5 6\nvn 1 0 0\nvn 0 1 0\nvn 0 0 1\n", "a.obj");
  EXPECT_EQ(result.cloud.points, kTwo);
  EXPECT_EQ(result.cloud.normals, (std::vector<Vec3d>{{1, 0, 0}, {0, 0, 1}}));
  EXPECT_EQ(result.report.bad_points, 1U);
}

TEST(PointIo, TakesTheCornersOfMeshes) {
  EXPECT_EQ(read("v 1 2 3\nv 4 5 6\nf 1 2 2\n", "a.obj").cloud.points, kTwo);
  EXPECT_EQ(read("OFF\n2 0 0\n1 2 3\n4 5 6\n", "a.off").cloud.points, kTwo);
}

MeshOrPoints read_either(const std::string& bytes, const std::string& name) {
  return read_mesh_or_points(std::string_view(bytes), name);
}

TEST(PointIo, WhatHasNoFacesIsAPointCloud) {
  EXPECT_TRUE(read_either("v 1 2 3\nv 4 5 6\n", "a.obj").points);
  EXPECT_TRUE(read_either("OFF\n2 0 0\n1 2 3\n4 5 6\n", "a.off").points);
  EXPECT_TRUE(read_either(ply(kVertices + "property float z\n", "1 2 3\n4 5 6\n"), "a.ply").points);
  EXPECT_TRUE(read_either("1.5 2 3\n4 5 6\n", "a.unknown").points);
  EXPECT_TRUE(read_either("8 6 12\n4 5 6\n", "a.xyz").points);
}

TEST(PointIo, WhatHasOrPromisesFacesIsAMesh) {
  EXPECT_TRUE(read_either("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "a.obj").mesh);
  EXPECT_TRUE(read_either("3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "a").mesh);
  EXPECT_THROW((void)read_either("v 0 0 0\nf 1 2 3\n", "a.obj"), InputError);
  EXPECT_THROW((void)read_either(ply(kVertices + "property float z\nelement face 1\n"
                                                 "property list uchar int vertex_indices\n",
                                     "1 2 3\n4 5 6\n"),
                                 "a.ply"),
               InputError);
}

TEST(PointIo, EveryCutOfAFileIsReadOrRefused) {
  const std::string whole =
      "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\n"
      "HEIGHT 1\nPOINTS 2\nDATA ascii\n1 2 3\n4 5 6\n";
  for (std::size_t length = 0; length < whole.size(); ++length) {
    try {
      EXPECT_LE(read(whole.substr(0, length), "a.pcd").cloud.points.size(), 2U);
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).substr(0, 5), "a.pcd");
    }
  }
}

}  // namespace
}  // namespace meshrepair
