// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <repair/repair.h>
#include <repair/transfer_attributes.h>

#include "shapes.h"
#include "textured.h"
#include "textured_surface.h"

namespace meshrepair {
namespace {

using namespace testing;
using Kind = CornerAttribute::Kind;

TexturedSurface repaired(const TexturedSoup& input, RepairOptions options = {}) {
  keep_attributes(input.soup, input.attributes, options);
  RepairReport report;
  TexturedSurface result;
  result.surface = repair(input.soup, options, report);
  EXPECT_TRUE(report.certify.passed());
  result.attributes = transfer_attributes(input.soup, input.attributes, result.surface);
  return result;
}

TEST(TransferAttributes, OverlappingSpheresKeepTheirAttributes) {
  const TexturedSoup input = textured({sphere(2000), sphere(1500, 0.8, {0.7, 0.3, 0.1})});
  const TexturedSurface result = repaired(input);
  EXPECT_EQ(result.attributes.materials.names.size(), 2u);
  expect_same_on_surface(input, result, 2000);
  expect_whole_triangles_bit_for_bit(input, result);
}

TEST(TransferAttributes, SurfacesFromCellsKeepTheirAttributes) {
  const TexturedSoup input = textured({sphere(500), sphere(400, 0.8, {0.7, 0.3, 0.1})});
  RepairOptions options;
  options.inside.rule = InsideRule::solidity;
  const TexturedSurface result = repaired(input, options);
  expect_same_on_surface(input, result, 1000);
  expect_whole_triangles_bit_for_bit(input, result);
}

// Sides in one plane: what is cut is not merged across materials and seams.
TEST(TransferAttributes, BoxesWithSidesInOnePlaneKeepTheirAttributes) {
  for (const InsideRule rule : {InsideRule::automatic, InsideRule::solidity}) {
    const TexturedSoup input = textured(
        {box({0, 0, 0}, {2, 2, 2}), box({1, 1, 0}, {3, 3, 2}), box({0.5, 0.5, 1}, {1.5, 1.25, 3})});
    RepairOptions options;
    options.inside.rule = rule;
    const TexturedSurface result = repaired(input, options);
    expect_same_on_surface(input, result, 2000);
  }
}

// A flat side of many triangles with different functions is cut by a box: points on the lines
// between them could all go, seen by their places alone.
TEST(TransferAttributes, SimplificationLeavesSeamsWhereTheyAre) {
  TexturedSoup input = textured({sphere(3000), sphere(3000, 1, {0.01, 0.003, 0.002})});
  const TexturedSurface result = repaired(input);
  expect_same_on_surface(input, result, 2000);
}

TEST(TransferAttributes, NormalsHaveLengthOneAndTurnWithTheirTriangles) {
  TexturedSoup input = textured({sphere(500), flipped(sphere(400, 0.8, {0.7, 0.3, 0.1}))});
  for (std::size_t i = 0; i < input.attributes.corners[1].values.size(); ++i) {
    const std::size_t second = 3 * sphere(500).points.size();
    if (i >= second) input.attributes.corners[1].values[i] *= -1;
  }
  const TexturedSurface result = repaired(input);
  const CornerAttribute& normals = result.attributes.corners[1];
  ASSERT_EQ(normals.kind, Kind::normal);
  for (std::size_t i = 0; i < normals.of_corner.size(); ++i) {
    ASSERT_NE(normals.of_corner[i], kNone);
    const double* const n = normals.values.data() + 3 * std::size_t{normals.of_corner[i]};
    const auto t = corners_of(result.surface.mesh, i / 3);
    const Vec3d normal(n[0], n[1], n[2]);
    EXPECT_NEAR(normal.norm(), 1, 1e-6);
    EXPECT_EQ(result.surface.source[i / 3] < sphere(500).triangles.size() &&
                  (t[1] - t[0]).cross(t[2] - t[0]).dot(normal) < 0,
              false);
  }
}

// Without some triangles around a point.
TexturedSoup with_hole(TexturedSoup input, const Vec3d& around, double radius) {
  Attributes& attributes = input.attributes;
  TexturedSoup result;
  result.soup.points = input.soup.points;
  result.attributes = attributes;
  result.attributes.materials.of_triangle.clear();
  result.attributes.groups.of_triangle.clear();
  for (CornerAttribute& attribute : result.attributes.corners) attribute.of_corner.clear();
  for (std::size_t t = 0; t < input.soup.triangles.size(); ++t) {
    const auto& c = input.soup.triangles[t];
    if ((input.soup.points[c[0]] - around).norm() < radius) continue;
    result.soup.triangles.push_back(c);
    result.attributes.materials.of_triangle.push_back(attributes.materials.of_triangle[t]);
    result.attributes.groups.of_triangle.push_back(attributes.groups.of_triangle[t]);
    for (std::size_t a = 0; a < attributes.corners.size(); ++a) {
      for (std::size_t k = 0; k < 3; ++k) {
        result.attributes.corners[a].of_corner.push_back(
            attributes.corners[a].of_corner[3 * t + k]);
      }
    }
  }
  return result;
}

TEST(TransferAttributes, PatchWithinOneChartContinuesIt) {
  const TexturedSoup whole = textured({sphere(2000)});
  const TexturedSurface result = repaired(with_hole(whole, Vec3d(1, 1, 0).normalized(), 0.3));
  std::size_t patches = 0;
  const CornerAttribute& texture = result.attributes.corners[0];
  for (std::size_t t = 0; t < result.surface.source.size(); ++t) {
    if (result.surface.source[t] != Surface::kNoSource) continue;
    ++patches;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d at = result.surface.mesh.points[result.surface.mesh.triangles[t][k]];
      const std::uint32_t value = texture.of_corner[3 * t + k];
      ASSERT_NE(value, kNone);
      EXPECT_NEAR(texture.values[2 * value], 0.75 + 0.1 * std::sin(at.x()) + 0.05 * at.z(), 0.01);
      EXPECT_NEAR(texture.values[2 * value + 1], 0.1 * at.y() * at.y() + 0.1 * at.z(), 0.02);
    }
    EXPECT_EQ(names_of(result.attributes.materials)[t], "material 0");
  }
  EXPECT_GT(patches, 10u);
}

// A box whose faces are flat to look at, without two of them that meet: the patch bends there.
TEST(TransferAttributes, NormalsOfPatchesGoOnWithTheRimAndBreakAtCreases) {
  TexturedSoup sides;
  sides.soup = box({0, 0, 0}, {2, 3, 4});
  CornerAttribute normals;
  normals.kind = Kind::normal;
  normals.components = 3;
  for (const auto& [a, b, c] : sides.soup.triangles) {
    const auto& p = sides.soup.points;
    const Vec3d n = (p[b] - p[a]).cross(p[c] - p[a]).normalized();
    for (int k = 0; k < 3; ++k) {
      normals.of_corner.push_back(static_cast<std::uint32_t>(normals.count()));
    }
    normals.values.insert(normals.values.end(), {n.x(), n.y(), n.z()});
  }
  sides.attributes.corners = {normals};
  sides.attributes.materials = sides.attributes.groups = {};
  sides.attributes.materials.of_triangle.assign(sides.soup.triangles.size(), kNone);
  sides.attributes.groups.of_triangle.assign(sides.soup.triangles.size(), kNone);
  RepairOptions options;
  options.holes.largest_share = options.holes.largest_flat_share = 10;
  const TexturedSurface result = repaired(with_hole(sides, Vec3d(0, 0, 0), 0.1), options);
  std::size_t patches = 0;
  for (std::size_t t = 0; t < result.surface.source.size(); ++t) {
    if (result.surface.source[t] != Surface::kNoSource) continue;
    ++patches;
    const auto& [a, b, c] = result.surface.mesh.triangles[t];
    const auto& p = result.surface.mesh.points;
    const Vec3d facing = (p[b] - p[a]).cross(p[c] - p[a]).normalized();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t value = result.attributes.corners[0].of_corner[3 * t + k];
      ASSERT_NE(value, kNone);
      const double* const n = result.attributes.corners[0].values.data() + 3 * std::size_t{value};
      EXPECT_GT(facing.dot(Vec3d(n[0], n[1], n[2])), 0.7);
      EXPECT_NEAR(Vec3d(n[0], n[1], n[2]).norm(), 1, 1e-12);
    }
  }
  EXPECT_GT(patches, 0u);
}

TEST(TransferAttributes, PatchWhereChartsMeetHasAMaterialOfItsOwn) {
  const TexturedSoup whole = textured({sphere(2000)});
  const TexturedSurface result = repaired(with_hole(whole, {1, 0, 0}, 0.3));
  std::size_t patches = 0;
  for (std::size_t t = 0; t < result.surface.source.size(); ++t) {
    const bool is_patch = result.surface.source[t] == Surface::kNoSource;
    patches += is_patch ? 1 : 0;
    EXPECT_EQ(names_of(result.attributes.materials)[t], is_patch ? kPatchMaterial : "material 0");
    EXPECT_EQ(names_of(result.attributes.groups)[t], "material 0_group");
    EXPECT_EQ(result.attributes.corners[0].of_corner[3 * t] == kNone, is_patch);
    EXPECT_NE(result.attributes.corners[1].of_corner[3 * t], kNone);
    EXPECT_NE(result.attributes.corners[2].of_corner[3 * t], kNone);
  }
  EXPECT_GT(patches, 10u);
}

TEST(TransferAttributes, OfTrianglesInOnePlaceTheOneThatFacesOutwardsCounts) {
  const TexturedSoup input = textured({flipped(sphere(300)), sphere(300), sphere(300)});
  for (const InsideRule rule : {InsideRule::automatic, InsideRule::solidity}) {
    RepairOptions options;
    options.inside.rule = rule;
    const TexturedSurface result = repaired(input, options);
    ASSERT_EQ(result.surface.mesh.triangles.size(), sphere(300).triangles.size());
    for (const std::string& name : names_of(result.attributes.materials)) {
      ASSERT_EQ(name, "material 1");
    }
  }
}

TEST(TransferAttributes, ValidMeshKeepsItsAttributes) {
  const TexturedSoup input = textured({sphere(300)});
  const TexturedSurface result = repaired(input);
  ASSERT_EQ(result.surface.mesh.triangles.size(), input.soup.triangles.size());
  expect_whole_triangles_bit_for_bit(input, result);
  EXPECT_EQ(names_of(result.attributes.groups), names_of(input.attributes.groups));
}

TEST(TransferAttributes, EmptyAttributesStayEmpty) {
  TexturedSoup input{sphere(300), {}};
  EXPECT_TRUE(repaired(input).attributes.empty());
}

// Halves of a triangle that is painted by halves, the whole of it turned over, and a patch.
TEST(TransferAttributes, PaintStaysInItsPlace) {
  const TriangleSoup input{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {1, 1, 0}}, {{{0, 1, 2}}}};
  Attributes attributes;
  attributes.paints.push_back({"paint_color", {{"841"}, {0}}});
  const Surface surface{
      {input.points, {{{0, 1, 3}}, {{3, 2, 0}}, {{0, 2, 1}}, {{1, 2, 0}}, {{0, 1, 2}}}},
      {0, 0, 0, 0, Surface::kNoSource},
      {1, 1, 1, 1}};
  const Attributes result = transfer_attributes(input, attributes, surface);
  ASSERT_EQ(result.paints.size(), 1u);
  const auto& [names, of_triangle] = result.paints[0].codes;
  ASSERT_EQ(of_triangle.size(), 5u);
  EXPECT_EQ(names[of_triangle[0]], "8");
  EXPECT_EQ(names[of_triangle[1]], "4");
  EXPECT_EQ(names[of_triangle[2]], "481");
  EXPECT_EQ(names[of_triangle[3]], "849");  // the first corner is the third one now
  EXPECT_EQ(of_triangle[4], kNone);
}

}  // namespace
}  // namespace meshrepair
