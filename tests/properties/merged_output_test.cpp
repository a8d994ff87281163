// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <vector>

#include <gtest/gtest.h>

#include <repair/repair.h>

#include "complexes.h"
#include "degenerate_soups.h"
#include "each_seed.h"
#include "shapes.h"
#include "share_of_cases.h"
#include "triangles_by_place.h"

namespace meshrepair {
namespace {

using namespace testing;

RepairResult repaired(const TriangleSoup& soup) {
  RepairOptions options;
  options.all_cells = true;
  options.simplify = 0;
  RepairResult result = repair(soup, options);
  expect_closed_manifold(result.surface.mesh);
  return result;
}

TEST(MergedOutput, SoundMeshesComeOutBitForBit) {
  const Eigen::Matrix3d turned =
      Eigen::AngleAxisd(0.7, Vec3d(1, 2, 3).normalized()).toRotationMatrix();
  for (const TriangleSoup& soup :
       {cube(), sphere(500), torus(20, 12), cone(50), transformed(sphere(300), turned),
        transformed(torus(13, 9), turned), moved(cube(), {1e3, 2e-3, 0.1})}) {
    const RepairResult result = repaired(soup);
    EXPECT_EQ(triangles_by_place(result.surface.mesh), triangles_by_place(soup));
    EXPECT_EQ(result.report.triangles.untouched, soup.triangles.size());
  }
}

TEST(MergedOutput, TrianglesKeepTheirFirstCorner) {
  const TriangleSoup soup = torus(9, 7);
  const RepairResult result = repaired(soup);
  for (std::size_t t = 0; t < result.surface.mesh.triangles.size(); ++t) {
    const auto& from = soup.triangles[result.surface.source[t]];
    const auto& to = result.surface.mesh.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(result.surface.mesh.points[to[k]], soup.points[from[k]]);
    }
  }
}

// Two boxes that share part of a side: what is left of each side is one polygon, with a notch or a
// hole.
TEST(MergedOutput, PolygonsMayHaveHoles) {
  TriangleSoup soup = box({0, 0, 0}, {10, 10, 10});
  append(soup, box({4, 4, 9}, {6, 6, 12}));
  const RepairResult result = repaired(soup);
  EXPECT_NEAR(signed_volume(result.surface.mesh), 1000 + 8, 1e-9);
  // Whole: ten of the large box, two of the small one. A square with a square hole takes eight
  // triangles, and each side of the small box two.
  EXPECT_EQ(result.report.triangles.untouched, 12u);
  EXPECT_EQ(result.report.triangles.cut, 10u);
  EXPECT_EQ(result.surface.mesh.triangles.size(), 28u);
}

// The faces between the cells of a block that are solid and those that are not, two triangles each.
TriangleSoup block_surface(std::int32_t size, std::uint64_t seed) {
  Random random(seed);
  const auto n = static_cast<std::size_t>(size);
  std::vector<char> solid(n * n * n, 0);
  for (char& s : solid) s = random.chance(0.5) ? 1 : 0;
  const auto is_solid = [&](const std::array<std::int32_t, 3>& c) {
    for (const std::int32_t x : c) {
      if (x < 0 || x >= size) return false;
    }
    return solid[static_cast<std::size_t>((c[2] * size + c[1]) * size + c[0])] != 0;
  };
  TriangleSoup soup;
  for (std::int32_t i = 0; i < size * size * size; ++i) {
    const std::array<std::int32_t, 3> cell = {i % size, i / size % size, i / size / size};
    if (!is_solid(cell)) continue;
    const Vec3d low(cell[0], cell[1], cell[2]);
    const TriangleSoup cube = box(low, low + Vec3d::Ones());
    // Faces of box(): low and high x, low and high y, low and high z.
    for (std::size_t face = 0; face < 6; ++face) {
      std::array<std::int32_t, 3> beyond = cell;
      beyond[face / 2] += face % 2 == 0 ? -1 : 1;
      if (is_solid(beyond)) continue;
      TriangleSoup side{cube.points, {cube.triangles[2 * face], cube.triangles[2 * face + 1]}};
      append(soup, side);
    }
  }
  return soup;
}

TEST(MergedOutput, SolidsThatTouchComeOutAsTheyAre) {
  std::size_t as_they_are = 0;
  for (const Touching touching : {Touching::separate, Touching::join}) {
    for_each_seed(15, [&](std::uint64_t seed) {
      const TriangleSoup soup = block_surface(4, seed);
      RepairOptions options;
      options.extract.touching = touching;
      const RepairResult result = repair(soup, options);
      expect_closed_manifold(result.surface.mesh);
      EXPECT_TRUE(result.report.certify.passed());
      EXPECT_NEAR(result.report.output_volume, signed_volume(soup), 1e-9);
      // Only an edge along which solids touch and have both ends in common has to be divided, which
      // cuts its four triangles.
      const std::size_t cut = soup.triangles.size() - result.report.triangles.untouched;
      EXPECT_EQ(cut % 4, 0u);
      EXPECT_EQ(result.surface.mesh.triangles.size(), soup.triangles.size() + cut);
      if (cut > 0) return;
      ++as_they_are;
      EXPECT_EQ(triangles_by_place(result.surface.mesh), triangles_by_place(soup));
    });
  }
  EXPECT_GT(as_they_are, expected_cases(5u));
}

TEST(MergedOutput, OutputIsNoLargerThanTheArrangementAsksFor) {
  TriangleSoup soup = sphere(2000);
  append(soup, moved(sphere(2000), {0.7, 0.1, 0.2}));
  const RepairResult result = repaired(soup);
  EXPECT_LT(result.surface.mesh.triangles.size(), soup.triangles.size());
  EXPECT_GT(result.report.extract.unmerged_triangles, 3 * result.surface.mesh.triangles.size());
}

// No triangle may vanish or turn round: areas add up to those of the facets.
TEST(MergedOutput, AreaAndVolumeStay) {
  for (const SoupFamily& family : degenerate_families()) {
    for_each_seed(4, [&](std::uint64_t seed) {
      SCOPED_TRACE(family.name + " " + std::to_string(seed));
      Cells cells = cells_of(family.make(seed));
      const auto cover = cover_of(cells);
      Random random(seed);
      std::vector<char> solid(cells.complex.cells.size(), 0);
      for (char& s : solid) s = random.chance(0.5) ? 1 : 0;
      ExtractReport report;
      const Surface surface = extract_surface(cells.complex, cover, solid, report);
      expect_closed_manifold(surface.mesh);
      double area = 0, volume = 0;
      const double unit = cells.complex.soup().grid.unit;
      for (const Facet& f : cells.complex.facets) {
        const auto is_solid = [&](CellId c) { return c.valid() && solid[c.index()] != 0; };
        if (is_solid(f.above) != is_solid(f.below)) {
          area += facet_area(
                      cells.complex,
                      FacetId(static_cast<std::size_t>(&f - cells.complex.facets.raw().data()))) *
                  unit * unit;
        }
      }
      for (CellId c(0u); c < cells.complex.cells.end_id(); ++c.value) {
        if (solid[c.index()] != 0) volume += cell_volume(cells.complex, c) * unit * unit * unit;
      }
      EXPECT_NEAR(surface_area(surface.mesh), area, 1e-9 * area);
      EXPECT_NEAR(signed_volume(surface.mesh), volume, 1e-9 * std::pow(area, 1.5));
    });
  }
}

}  // namespace
}  // namespace meshrepair
