// SPDX-License-Identifier: MIT
#include "tangent_plane.h"

#include <cmath>
#include <numeric>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "random_geometry.h"

namespace meshrepair {
namespace {

std::vector<std::uint32_t> all_but_first(const std::vector<Vec3d>& points) {
  std::vector<std::uint32_t> others(points.size() - 1);
  std::iota(others.begin(), others.end(), 1U);
  return others;
}

TEST(TangentPlane, PointsInAPlaneGetThatPlane) {
  testing::Random random(7);
  const Vec3d normal = Vec3d(1, 2, -2) / 3;
  const Vec3d axis = normal.unitOrthogonal();
  const Vec3d other = normal.cross(axis);
  std::vector<Vec3d> points = {{5, 5, 5}};
  for (int i = 0; i < 12; ++i) {
    points.emplace_back(points[0] + random.real(-1, 1) * axis + random.real(-1, 1) * other);
  }
  const TangentPlane plane = fit_tangent_plane(points, 0, all_but_first(points));
  EXPECT_NEAR(std::abs(plane.normal.dot(normal)), 1, 1e-9);
  EXPECT_NEAR(plane.roughness, 0, 1e-9);
  EXPECT_FALSE(plane.line);
}

TEST(TangentPlane, SaysThatPointsLieAlongALine) {
  std::vector<Vec3d> points;
  for (int i = 0; i < 10; ++i) points.emplace_back(i, 0.001 * (i % 2), 0);
  EXPECT_TRUE(fit_tangent_plane(points, 0, all_but_first(points)).line);
}

TEST(TangentPlane, CoincidingPointsGetSomePlane) {
  const std::vector<Vec3d> points(5, Vec3d(1, 1, 1));
  const TangentPlane plane = fit_tangent_plane(points, 0, all_but_first(points));
  EXPECT_NEAR(plane.normal.norm(), 1, 1e-12);
}

TEST(TangentPlane, PointsWithoutNeighboursGetSomePlane) {
  EXPECT_NEAR(fit_tangent_plane({{0, 0, 0}}, 0, {}).normal.norm(), 1, 1e-12);
}

}  // namespace
}  // namespace meshrepair
