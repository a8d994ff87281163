// SPDX-License-Identifier: MIT
// What walls of sheets carry.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include <repair/repair.h>
#include <repair/transfer_attributes.h>

#include "sheets.h"

namespace meshrepair {
namespace {

using namespace testing;
using Kind = CornerAttribute::Kind;

// Each triangle with its corners' places as texture coordinates, and with its own normal.
Attributes places_and_normals(const TriangleSoup& soup) {
  Attributes attributes;
  CornerAttribute places, normals;
  places.components = normals.components = 3;
  normals.kind = Kind::normal;
  for (const auto& [a, b, c] : soup.triangles) {
    const auto& at = soup.points;
    const Vec3d normal = (at[b] - at[a]).cross(at[c] - at[a]).normalized();
    for (const std::uint32_t p : {a, b, c}) {
      places.of_corner.push_back(static_cast<std::uint32_t>(places.count()));
      places.values.insert(places.values.end(), at[p].begin(), at[p].end());
      normals.of_corner.push_back(static_cast<std::uint32_t>(normals.count()));
      normals.values.insert(normals.values.end(), normal.begin(), normal.end());
    }
  }
  attributes.corners = {places, normals};
  attributes.materials.names = {"leaf", "back"};
  attributes.materials.of_triangle.assign(soup.triangles.size(), 0);
  return attributes;
}

struct Wall {
  Surface surface;
  Attributes attributes;

  [[nodiscard]] Vec3d value(std::size_t attribute, std::size_t corner) const {
    const CornerAttribute& all = attributes.corners[attribute];
    const double* const first = all.values.data() + 3 * std::size_t{all.of_corner[corner]};
    return {first[0], first[1], first[2]};
  }
  [[nodiscard]] const Vec3d& place(std::size_t corner) const {
    return surface.mesh.points[surface.mesh.triangles[corner / 3][corner % 3]];
  }
  [[nodiscard]] Vec3d normal(std::size_t t) const {
    return (place(3 * t + 1) - place(3 * t)).cross(place(3 * t + 2) - place(3 * t)).normalized();
  }
};

Wall wall_of(const TriangleSoup& soup, const Attributes& attributes, double thickness) {
  RepairOptions options;
  options.thicken.thickness = thickness;
  keep_attributes(soup, attributes, options);
  RepairResult result = repair(soup, options);
  EXPECT_TRUE(result.report.certify.passed());
  Attributes carried = transfer_attributes(soup, attributes, result.surface, true);
  return {std::move(result.surface), std::move(carried)};
}

// Where the wall is round, of a place that is a little farther.
TEST(WallAttributes, AreThoseOfThePlaceBelow) {
  constexpr double kThickness = 0.02;
  Random random(3);
  for (int i = 0; i < 12; ++i) {
    const TriangleSoup sheet = i % 2 == 0 ? curved_sheet(random) : folded_sheet(random);
    const Wall wall = wall_of(sheet, places_and_normals(sheet), kThickness);
    for (std::size_t c = 0; c < 3 * wall.surface.mesh.triangles.size(); ++c) {
      ASSERT_NE(wall.surface.source[c / 3], Surface::kNoSource);
      EXPECT_LE((wall.value(0, c) - wall.place(c)).norm(), kThickness);
      EXPECT_GT(wall.value(1, c).dot(wall.normal(c / 3)), 0.6);
      EXPECT_NEAR(wall.value(1, c).norm(), 1, 1e-9);
    }
    EXPECT_EQ(std::count(wall.attributes.materials.of_triangle.begin(),
                         wall.attributes.materials.of_triangle.end(), 0u),
              static_cast<std::ptrdiff_t>(wall.surface.mesh.triangles.size()));
  }
}

TriangleSoup unit_card() {
  return sheet_of(1, 1, [](double u, double v) { return Vec3d(u, v, 0); });
}

TEST(WallAttributes, EachFaceOfACardHasItsOwn) {
  TriangleSoup card = unit_card();
  const std::size_t front = card.triangles.size();
  append(card, flipped(card));
  Attributes attributes = places_and_normals(card);
  std::fill(attributes.materials.of_triangle.begin() + static_cast<std::ptrdiff_t>(front),
            attributes.materials.of_triangle.end(), 1);
  const Wall wall = wall_of(card, attributes, 0.01);
  std::array<std::size_t, 2> seen{};
  for (std::size_t t = 0; t < wall.surface.mesh.triangles.size(); ++t) {
    const double up = wall.normal(t).z();
    if (std::abs(up) < 0.5) continue;
    const std::uint32_t material = wall.attributes.materials.of_triangle[t];
    EXPECT_EQ(material, up > 0 ? 0u : 1u);
    ++seen[material];
  }
  EXPECT_GT(seen[0], 0u);
  EXPECT_GT(seen[1], 0u);
}

}  // namespace
}  // namespace meshrepair
