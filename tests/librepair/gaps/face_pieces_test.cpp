// SPDX-License-Identifier: MIT
// Triangles in pieces.
#include "gaps/face_pieces.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace meshrepair::internal {
namespace {

// A large triangle with a square in it, which does not touch it.
const std::vector<Vec3d> kPoints = {{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {2, 2, 0},
                                    {3, 2, 0}, {3, 3, 0},  {2, 3, 0},  {5, 0, 0}};
const std::vector<EdgeEnds> kSquare = {{3, 4}, {4, 5}, {5, 6}, {3, 6}};

double area_of(const std::vector<IndexTriangle>& pieces) {
  double sum = 0;
  for (const auto& [a, b, c] : pieces) {
    const double area = (kPoints[b] - kPoints[a]).cross(kPoints[c] - kPoints[a]).z() / 2;
    EXPECT_GT(area, 0);
    sum += area;
  }
  return sum;
}

TEST(FacePieces, PiecesCoverTheFace) {
  FacePieces faces(kPoints);
  std::vector<IndexTriangle> pieces;
  EXPECT_TRUE(faces.cut(std::array{0u, 7u, 1u, 2u}, kSquare, {0, 0, 1}, pieces));
  EXPECT_DOUBLE_EQ(area_of(pieces), 50);
  EXPECT_EQ(pieces.size(), 10u);
}

TEST(FacePieces, WhatTwoFacesHaveInCommonIsCutAlike) {
  FacePieces faces(kPoints);
  std::vector<IndexTriangle> of_face, of_square;
  EXPECT_TRUE(faces.cut(std::array{0u, 1u, 2u}, kSquare, {0, 0, 1}, of_face));
  EXPECT_TRUE(faces.cut(std::array{3u, 6u, 5u, 4u}, {}, {0, 0, -1}, of_square));
  ASSERT_EQ(of_square.size(), 2u);
  for (IndexTriangle piece : of_square) {
    std::swap(piece[1], piece[2]);
    EXPECT_NE(std::find(of_face.begin(), of_face.end(), piece), of_face.end());
  }
}

TEST(FacePieces, FlatTriangleHasNone) {
  FacePieces faces(kPoints);
  std::vector<IndexTriangle> pieces;
  EXPECT_TRUE(faces.cut(std::array{0u, 7u, 1u, 7u}, {}, {0, 0, 1}, pieces));
  EXPECT_TRUE(pieces.empty());
}

}  // namespace
}  // namespace meshrepair::internal
