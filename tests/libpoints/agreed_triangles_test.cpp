// SPDX-License-Identifier: MIT
#include "agreed_triangles.h"

#include <gtest/gtest.h>

#include "drop_crumbs.h"
#include "single_fans.h"

namespace meshrepair {
namespace {

const std::vector<Vec3d> kSquare = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

std::vector<TangentPlane> flat(std::size_t points) {
  TangentPlane plane;
  plane.normal = Vec3d::UnitZ();
  return std::vector<TangentPlane>(points, plane);
}

VotedTriangle triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, int votes = 3) {
  return {{a, b, c}, static_cast<std::uint8_t>(votes), 1};
}

std::vector<std::array<std::uint32_t, 3>> corners_of(const std::vector<VotedTriangle>& triangles) {
  std::vector<std::array<std::uint32_t, 3>> corners;
  for (const VotedTriangle& t : triangles) corners.push_back(t.corners);
  return corners;
}

using Corners = std::vector<std::array<std::uint32_t, 3>>;

TEST(AgreedTriangles, DiagonalWithMoreVotesStays) {
  const std::vector<VotedTriangle> wanted = {triangle(0, 1, 2, 1), triangle(0, 1, 3, 2),
                                             triangle(0, 2, 3, 1), triangle(1, 2, 3, 2)};
  EXPECT_EQ(corners_of(agreed_triangles(kSquare, flat(4), wanted, nullptr)),
            (Corners{{0, 1, 3}, {1, 2, 3}}));
}

TEST(AgreedTriangles, TurnDoesNotMatter) {
  const std::vector<VotedTriangle> wanted = {triangle(0, 2, 1), triangle(0, 2, 3)};
  EXPECT_EQ(agreed_triangles(kSquare, flat(4), wanted, nullptr).size(), 2U);
}

TEST(AgreedTriangles, SmallerOfOverlappingTrianglesStays) {
  std::vector<VotedTriangle> wanted = {triangle(0, 1, 2), triangle(0, 1, 3)};
  wanted[0].size = 2;
  EXPECT_EQ(corners_of(agreed_triangles(kSquare, flat(4), wanted, nullptr)), (Corners{{0, 1, 3}}));
}

TEST(AgreedTriangles, AtMostTwoTrianglesMeetInAnEdge) {
  std::vector<Vec3d> points = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0.5}, {-1, 1, 0.5}, {-1, -1, 0.5}};
  TangentPlane plane;
  plane.normal = Vec3d::UnitX();
  const std::vector<VotedTriangle> wanted = {triangle(0, 1, 2), triangle(0, 1, 3),
                                             triangle(0, 1, 4)};
  EXPECT_LE(agreed_triangles(points, std::vector<TangentPlane>(5, plane), wanted, nullptr).size(),
            2U);
}

// More than are looked at at a time: those that come first are in the way of all.
TEST(AgreedTriangles, DiagonalsWithMoreVotesStayAllOverALargeGrid) {
  constexpr std::uint32_t kSide = 220;
  std::vector<Vec3d> points;
  for (std::uint32_t i = 0; i < kSide * kSide; ++i) points.emplace_back(i % kSide, i / kSide, 0);
  std::vector<VotedTriangle> wanted;
  Corners expected;
  for (std::uint32_t i = 0; i < kSide * (kSide - 1); ++i) {
    if (i % kSide == kSide - 1) continue;
    const std::uint32_t a = i, b = i + 1, c = i + kSide + 1, d = i + kSide;
    wanted.push_back(triangle(a, b, d, 1));
    wanted.push_back(triangle(b, c, d, 1));
    for (const Corners::value_type& t : {Corners::value_type{a, b, c}, {a, c, d}}) {
      wanted.push_back(triangle(t[0], t[1], t[2], 2));
      expected.push_back(t);
    }
  }
  const std::vector<TangentPlane> planes = flat(points.size());
  EXPECT_EQ(corners_of(agreed_triangles(points, planes, wanted, nullptr)), expected);
}

// Two fans of different sizes around point 0, as in a bow tie.
TEST(SingleFans, TheSmallerFanGoes) {
  std::vector<VotedTriangle> bow = {triangle(0, 1, 2), triangle(0, 2, 3), triangle(0, 4, 5)};
  EXPECT_EQ(keep_single_fans(bow, 6), 1U);
  EXPECT_EQ(corners_of(bow), (Corners{{0, 1, 2}, {0, 2, 3}}));
}

TEST(SingleFans, PointsWithOneFanStay) {
  std::vector<VotedTriangle> fan = {triangle(0, 1, 2), triangle(0, 2, 3), triangle(0, 3, 1)};
  EXPECT_EQ(keep_single_fans(fan, 4), 0U);
  EXPECT_EQ(fan.size(), 3U);
}

TEST(Crumbs, OpenPiecesOfFewTrianglesGo) {
  std::vector<VotedTriangle> triangles = {triangle(0, 1, 2), triangle(1, 2, 3), triangle(4, 5, 6)};
  EXPECT_EQ(drop_crumbs(triangles, 2, 0), 1U);
  EXPECT_EQ(corners_of(triangles), (Corners{{0, 1, 2}, {1, 2, 3}}));
}

TEST(Crumbs, AClosedPieceStaysHoweverSmall) {
  std::vector<VotedTriangle> tetrahedron = {triangle(0, 1, 2), triangle(0, 1, 3), triangle(0, 2, 3),
                                            triangle(1, 2, 3)};
  EXPECT_EQ(drop_crumbs(tetrahedron, 20, 0), 0U);
}

// A strip of so many triangles from a point on.
void append_strip(std::vector<VotedTriangle>& triangles, std::uint32_t first, std::uint32_t count,
                  std::uint8_t votes, float size) {
  for (std::uint32_t t = 0; t < count; ++t) {
    triangles.push_back({{first + t, first + t + 1, first + t + 2}, votes, size});
  }
}

TEST(Crumbs, SmallPiecesThatFewCornersWantGo) {
  std::vector<VotedTriangle> triangles;
  append_strip(triangles, 0, 1000, 3, 1);
  append_strip(triangles, 2000, 90, 3, 1);
  append_strip(triangles, 3000, 90, 1, 1);
  append_strip(triangles, 4000, 110, 1, 1);  // not that small
  EXPECT_EQ(drop_crumbs(triangles, 20, 5), 90U);
  EXPECT_EQ(triangles.size(), 1200U);
}

TEST(Crumbs, TinyPiecesOfLargeTrianglesGo) {
  for (const double coarse : {5.0, 0.0}) {
    std::vector<VotedTriangle> triangles;
    append_strip(triangles, 0, 2000, 3, 1);
    append_strip(triangles, 3000, 30, 3, 4);
    append_strip(triangles, 4000, 30, 3, 6);
    append_strip(triangles, 5000, 50, 3, 6);  // not that small
    EXPECT_EQ(drop_crumbs(triangles, 20, coarse), coarse > 0 ? 30U : 0U);
  }
}

}  // namespace
}  // namespace meshrepair
