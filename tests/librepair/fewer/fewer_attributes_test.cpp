// SPDX-License-Identifier: MIT
// What triangles carry, where many of them go.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include <check/check_surface.h>
#include <mesh/triangle_paint.h>
#include <repair/repair.h>
#include <repair/transfer_attributes.h>

#include "shapes.h"
#include "textured.h"
#include "textured_surface.h"

namespace meshrepair {
namespace {

using namespace testing;

TexturedSurface reduced(const TexturedSoup& input, double share) {
  RepairOptions options;
  options.fewer.share = share;
  options.fewer.attributes = &input.attributes;
  keep_attributes(input.soup, input.attributes, options);
  RepairReport report;
  TexturedSurface result;
  result.surface = repair(input.soup, options, report);
  EXPECT_TRUE(check_surface(result.surface.mesh).valid_solid());
  result.attributes = transfer_attributes(input.soup, input.attributes, result.surface, false,
                                          report.fewer.corners);
  return result;
}

// As texture_of() has them.
std::array<double, 2> texture_at(const Vec3d& at, int chart) {
  return {0.25 * chart + 0.1 * std::sin(at.x()) + 0.05 * at.z(),
          0.1 * at.y() * at.y() + 0.1 * at.z()};
}

TEST(FewerAttributes, EachTriangleHasTheTextureOfItsPlaceInOneChart) {
  TexturedSoup input;
  input.soup = sphere(8000);
  input.attributes.corners = {texture_of(input.soup)};
  const TexturedSurface result = reduced(input, 0.1);
  const TriangleSoup& mesh = result.surface.mesh;
  EXPECT_LT(mesh.triangles.size(), 900u);
  const CornerAttribute& texture = result.attributes.corners.at(0);
  std::array<std::size_t, 4> of_chart{};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    int chart = -1;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t value = texture.of_corner[3 * t + k];
      ASSERT_NE(value, kNone);
      const Vec3d& at = mesh.points[mesh.triangles[t][k]];
      const double u = texture.values[2 * value];
      const int own = static_cast<int>(std::lround((u - texture_at(at, 0)[0]) / 0.25));
      if (k == 0) chart = own;
      ASSERT_EQ(own, chart);
      EXPECT_NEAR(u, texture_at(at, chart)[0], 0.01);
      EXPECT_NEAR(texture.values[2 * value + 1], texture_at(at, chart)[1], 0.01);
    }
    ASSERT_TRUE(chart >= 0 && chart < 4);
    ++of_chart[static_cast<std::size_t>(chart)];
  }
  for (const std::size_t triangles : of_chart) EXPECT_GT(triangles, 50u);
}

// The seam of a chart with itself: both sides are one piece of the picture's plane elsewhere.
TEST(FewerAttributes, AChartDoesNotReachOverItsOwnSeam) {
  TexturedSoup input;
  input.soup = sphere(8000);
  CornerAttribute around = texture_of(input.soup);
  around.values.clear();
  around.of_corner.clear();
  for (const auto& t : input.soup.triangles) {
    double first = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d& at = input.soup.points[t[k]];
      double angle = std::atan2(at.y(), at.x()) / 6.283185307179586 + 0.5;
      if (k == 0) first = angle;
      if (angle - first > 0.5) angle -= 1;
      if (angle - first < -0.5) angle += 1;
      around.of_corner.push_back(static_cast<std::uint32_t>(around.count()));
      around.values.insert(around.values.end(), {angle, at.z()});
    }
  }
  input.attributes.corners = {around};
  const TexturedSurface result = reduced(input, 0.2);
  const TriangleSoup& mesh = result.surface.mesh;
  const CornerAttribute& texture = result.attributes.corners.at(0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::array<double, 3> u{};
    double nearest_to_axis = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      u[k] = texture.values[2 * texture.of_corner[3 * t + k]];
      const Vec3d& at = mesh.points[mesh.triangles[t][k]];
      nearest_to_axis = std::min(nearest_to_axis, std::hypot(at.x(), at.y()));
    }
    if (nearest_to_axis < 0.3) continue;  // the angle is no function of the place there
    EXPECT_LT(std::abs(u[1] - u[0]), 0.25);
    EXPECT_LT(std::abs(u[2] - u[0]), 0.25);
  }
}

// As modelling programs unwrap spheres: each triangle at a pole has a place of its own there.
TEST(FewerAttributes, PolesOfATextureDoNotHoldTheirFans) {
  constexpr std::uint32_t kAround = 60, kRings = 30;
  TexturedSoup input;
  CornerAttribute texture;
  texture.kind = CornerAttribute::Kind::texture;
  const auto point = [&](std::uint32_t ring, std::uint32_t i) {
    if (ring == 0) return 0u;
    if (ring == kRings) return 1u;
    return 2 + (ring - 1) * kAround + i % kAround;
  };
  input.soup.points.resize(2 + (kRings - 1) * kAround);
  const auto add = [&](std::array<std::array<std::uint32_t, 2>, 3> corners, double middle) {
    std::array<std::uint32_t, 3> triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& [ring, i] = corners[k];
      triangle[k] = point(ring, i);
      const double across = 3.141592653589793 * ring / kRings,
                   around = 2 * 3.141592653589793 * i / kAround;
      input.soup.points[triangle[k]] = {std::sin(across) * std::cos(around),
                                        std::sin(across) * std::sin(around), std::cos(across)};
      const bool is_pole = ring == 0 || ring == kRings;
      texture.of_corner.push_back(static_cast<std::uint32_t>(texture.count()));
      texture.values.push_back((is_pole ? middle : i) / kAround);
      texture.values.push_back(static_cast<double>(ring) / kRings);
    }
    input.soup.triangles.push_back(triangle);
  };
  for (std::uint32_t ring = 0; ring < kRings; ++ring) {
    for (std::uint32_t i = 0; i < kAround; ++i) {
      const double middle = i + 0.5;
      if (ring + 1 < kRings) add({{{ring, i}, {ring + 1, i}, {ring + 1, i + 1}}}, middle);
      if (ring > 0) add({{{ring, i}, {ring + 1, i + 1}, {ring, i + 1}}}, middle);
    }
  }
  ASSERT_TRUE(check_surface(input.soup).valid_solid());
  input.attributes.corners = {texture};
  const TexturedSurface result = reduced(input, 0.05);
  const TriangleSoup& mesh = result.surface.mesh;
  EXPECT_LT(mesh.triangles.size(), 200u);
  const CornerAttribute& carried = result.attributes.corners.at(0);
  for (std::size_t c = 0; c < carried.of_corner.size(); ++c) {
    const Vec3d& at = mesh.points[mesh.triangles[c / 3][c % 3]];
    ASSERT_NE(carried.of_corner[c], kNone);
    const double v = carried.values[2 * carried.of_corner[c] + 1];
    EXPECT_NEAR(v, std::acos(std::clamp(at.normalized().z(), -1.0, 1.0)) / 3.141592653589793, 0.03);
  }
}

TEST(FewerAttributes, NormalsStayNormals) {
  TexturedSoup input;
  input.soup = sphere(4000);
  input.attributes.corners = {normals_of(input.soup)};
  const TexturedSurface result = reduced(input, 0.1);
  const TriangleSoup& mesh = result.surface.mesh;
  const CornerAttribute& normals = result.attributes.corners.at(0);
  for (std::size_t c = 0; c < normals.of_corner.size(); ++c) {
    ASSERT_NE(normals.of_corner[c], kNone);
    const double* const n = normals.values.data() + 3 * std::size_t{normals.of_corner[c]};
    const Vec3d normal(n[0], n[1], n[2]);
    EXPECT_NEAR(normal.norm(), 1, 1e-6);
    EXPECT_GT(normal.dot(mesh.points[mesh.triangles[c / 3][c % 3]].normalized()), 0.99);
  }
}

// Painted triangles keep their border; divided ones stay as they are.
TEST(FewerAttributes, PaintStaysOnItsSide) {
  TexturedSoup input;
  input.soup = torus(60, 30);
  TrianglePaint paint;
  paint.name = "paint_color";
  paint.codes.names = {"4", "8"};
  paint.codes.of_triangle.assign(input.soup.triangles.size(), kNone);
  const auto is_above = [](const TriangleSoup& soup, std::size_t t) {
    const auto& c = soup.triangles[t];
    return (soup.points[c[0]] + soup.points[c[1]] + soup.points[c[2]]).z() > 0;
  };
  for (std::size_t t = 0; t < input.soup.triangles.size(); ++t) {
    if (is_above(input.soup, t)) paint.codes.of_triangle[t] = 0;
  }
  const std::string divided = "48443";  // three sides: four pieces
  ASSERT_TRUE(PaintCode(divided).is_divided());
  paint.codes.names.push_back(divided);
  paint.codes.of_triangle[7] = 2;
  input.attributes.paints = {paint};
  const TexturedSurface result = reduced(input, 0.1);
  const TriangleSoup& mesh = result.surface.mesh;
  const TriangleLabels& codes = result.attributes.paints.at(0).codes;
  std::size_t of_divided = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t code = codes.of_triangle[t];
    if (code != kNone && codes.names[code] == divided) {
      ++of_divided;
      EXPECT_EQ(corners_of(mesh, t), corners_of(input.soup, 7));
      continue;
    }
    EXPECT_EQ(code != kNone, is_above(mesh, t));
    EXPECT_TRUE(code == kNone || codes.names[code] == "4");
  }
  EXPECT_EQ(of_divided, 1u);
}

}  // namespace
}  // namespace meshrepair
