// SPDX-License-Identifier: MIT
#include <bit>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <extract/extract_surface.h>

#include "complexes.h"
#include "degenerate_soups.h"

namespace meshrepair {
namespace {

using namespace testing;

using Bits = std::array<std::uint64_t, 3>;

Bits bits_of(const Vec3d& p) {
  return {std::bit_cast<std::uint64_t>(p.x()), std::bit_cast<std::uint64_t>(p.y()),
          std::bit_cast<std::uint64_t>(p.z())};
}

std::set<Bits> point_bits(const TriangleSoup& soup) {
  std::set<Bits> bits;
  for (const Vec3d& p : soup.points) bits.insert(bits_of(p));
  return bits;
}

struct Extracted {
  Cells cells;
  IdVector<FacetId, Cover> cover;
  Surface surface;
};

template <class Inside>
Extracted extract(const TriangleSoup& soup, Inside inside) {
  Cells cells = cells_of(soup);
  auto cover = cover_of(cells);
  ExtractReport report;
  Surface surface =
      extract_surface(cells.complex, cover, solid_where(cells.complex, inside), report);
  return {std::move(cells), std::move(cover), std::move(surface)};
}

TEST(ExtractSurface, PointsOfACleanMeshComeOutBitForBit) {
  for (const TriangleSoup& soup :
       {sphere(400, 1 / 3.0, {0.1, 0.2, 0.3}), moved(torus(20, 12, 2, 0.7), {1 / 3.0, 1e3, -1e6}),
        scaled(noisy_sphere(300, 0.02, 1), 1e-60)}) {
    Cells cells = cells_of(soup);
    const auto cover = cover_of(cells);
    ExtractReport report;
    const Surface surface =
        extract_surface(cells.complex, cover, enclosed_cells(cells.complex, cover), report);
    expect_closed_manifold(surface.mesh);
    EXPECT_EQ(report.singular_edges, 0u);
    EXPECT_EQ(report.singular_vertices, 0u);
    EXPECT_NEAR(surface_area(surface.mesh) / surface_area(soup), 1, 1e-6);
    const std::set<Bits> out = point_bits(surface.mesh);
    for (const Vec3d& p : soup.points) EXPECT_TRUE(out.contains(bits_of(p))) << p.transpose();
    for (const std::uint32_t source : surface.source) EXPECT_NE(source, Surface::kNoSource);
  }
}

TEST(ExtractSurface, ACubeIsItselfBitForBit) {
  const TriangleSoup soup = moved(scaled(cube(), 0.1), {1 / 3.0, 1 / 7.0, 1e3});
  const Vec3d low = soup.points[0];
  const Extracted e = extract(soup, [&](const Vec3d& at) {
    return ((at - low).array() > 0).all() && ((at - low).array() < 0.1).all();
  });
  expect_closed_manifold(e.surface.mesh);
  EXPECT_EQ(e.surface.mesh.triangles.size(), 12u);
  EXPECT_EQ(point_bits(e.surface.mesh), point_bits(soup));
}

TEST(ExtractSurface, EveryTriangleLiesInItsSource) {
  const TriangleSoup soup = two_overlapping_spheres(400);
  const Extracted e = extract(soup, [&](const Vec3d& at) {
    return at.norm() < 0.9 || (at - Vec3d(0.7, 0.31, 0.17)).norm() < 0.9;
  });
  const auto& mesh = e.surface.mesh;
  ASSERT_EQ(e.surface.source.size(), mesh.triangles.size());
  std::size_t with_source = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (e.surface.source[t] == Surface::kNoSource) continue;
    ++with_source;
    const auto& from = soup.triangles.at(e.surface.source[t]);
    const Vec3d& a = soup.points[from[0]];
    const Vec3d normal = (soup.points[from[1]] - a).cross(soup.points[from[2]] - a).normalized();
    for (const std::uint32_t corner : mesh.triangles[t]) {
      EXPECT_NEAR(normal.dot(mesh.points[corner] - a), 0, 1e-6);
    }
  }
  EXPECT_GT(with_source, 100u);
}

// Coplanar pieces that are cut are merged, unless each is to lie in its source.
TEST(ExtractSurface, TrianglesAreMergedOnlyIfTheyMay) {
  TriangleSoup soup = box({0, 0, 0}, {4, 4, 4});
  append(soup, box({1, 1, 2}, {3, 3, 5}));
  Cells cells = cells_of(soup);
  const auto cover = cover_of(cells);
  const std::vector<char> solid = enclosed_cells(cells.complex, cover);
  ExtractReport report;
  (void)extract_surface(cells.complex, cover, solid, report);
  const std::size_t merged = report.regions;
  ExtractOptions options;
  options.merges_triangles = false;
  (void)extract_surface(cells.complex, cover, solid, report, options);
  EXPECT_GT(report.regions, merged);
}

TEST(ExtractSurface, NothingSolidIsNoTriangle) {
  const Extracted e = extract(cube(), [](const Vec3d&) { return false; });
  EXPECT_TRUE(e.surface.mesh.triangles.empty());
  EXPECT_TRUE(e.surface.mesh.points.empty());
}

TEST(ExtractSurface, NoPointIsUnusedAndNoTriangleHasEqualCorners) {
  for (const SoupFamily& family : degenerate_families()) {
    SCOPED_TRACE(family.name);
    Random random(1);
    const Extracted e = extract(family.make(4), [&](const Vec3d&) { return random.chance(0.5); });
    std::vector<char> used(e.surface.mesh.points.size(), 0);
    for (const auto& t : e.surface.mesh.triangles) {
      EXPECT_TRUE(t[0] != t[1] && t[1] != t[2] && t[2] != t[0]);
      for (const std::uint32_t corner : t) used.at(corner) = 1;
    }
    EXPECT_EQ(std::count(used.begin(), used.end(), 0), 0);
    for (const Vec3d& p : e.surface.mesh.points) EXPECT_TRUE(p.allFinite());
  }
}

}  // namespace
}  // namespace meshrepair
