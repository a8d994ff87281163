// SPDX-License-Identifier: MIT
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <check/self_intersections.h>
#include <extract/cut_nonmanifold.h>

#include "complexes.h"
#include "degenerate_soups.h"
#include "each_seed.h"
#include "share_of_cases.h"

namespace meshrepair {
namespace {

using namespace testing;

// Unit cubes of a 3 x 3 x 3 grid, named by their lowest corner.
using Cube = std::array<int, 3>;

struct ExtractedCells {
  Surface surface;
  ExtractReport report;
};

constexpr std::array<Touching, 2> kBothWays = {Touching::separate, Touching::join};

// The complex has all the planes x, y, z = 0, 1, 2, 3; the solid is just these cubes.
ExtractedCells extract_cubes(const std::vector<Cube>& solid_cubes,
                             Touching touching = Touching::separate) {
  TriangleSoup soup;
  for (int x = 0; x < 3; ++x) {
    append(soup, box(Vec3d(x, 0, 0), Vec3d(x + 1, 3, 3)));
    append(soup, box(Vec3d(0, x, 0), Vec3d(3, x + 1, 3)));
    append(soup, box(Vec3d(0, 0, x), Vec3d(3, 3, x + 1)));
  }
  Cells cells = cells_of(soup);
  const auto cover = cover_of(cells);
  const std::vector<char> solid = solid_where(cells.complex, [&](const Vec3d& at) {
    for (const Cube& c : solid_cubes) {
      const Vec3d low(c[0], c[1], c[2]);
      if ((at - low).minCoeff() > 0 && (at - low).maxCoeff() < 1) return true;
    }
    return false;
  });
  ExtractedCells result;
  result.surface = extract_surface(cells.complex, cover, solid, result.report, {touching});
  expect_closed_manifold(result.surface.mesh);
  EXPECT_EQ(self_intersections(result.surface.mesh).count, 0u);
  EXPECT_NEAR(signed_volume(result.surface.mesh), static_cast<double>(solid_cubes.size()), 1e-9);
  return result;
}

std::size_t parts_of(const Surface& surface) {
  return examine_topology(surface.mesh.triangles, surface.mesh.points.size()).parts;
}

TEST(CutNonmanifold, ACubeHasNoSingularities) {
  const ExtractedCells e = extract_cubes({{1, 1, 1}});
  EXPECT_EQ(e.report.singular_edges, 0u);
  EXPECT_EQ(e.report.singular_vertices, 0u);
  EXPECT_EQ(e.report.middle_vertices, 0u);
}

TEST(CutNonmanifold, CubesThatShareAnEdgeAreSeparated) {
  const ExtractedCells e = extract_cubes({{0, 0, 1}, {1, 1, 1}});
  EXPECT_EQ(e.report.singular_edges, 1u);
  EXPECT_EQ(e.report.singular_vertices, 2u);
  EXPECT_EQ(e.report.middle_vertices, 0u);
  EXPECT_EQ(parts_of(e.surface), 2u);
}

TEST(CutNonmanifold, CubesThatShareAVertexAreSeparated) {
  const ExtractedCells e = extract_cubes({{0, 0, 0}, {1, 1, 1}});
  EXPECT_EQ(e.report.singular_edges, 0u);
  EXPECT_EQ(e.report.singular_vertices, 1u);
  EXPECT_EQ(parts_of(e.surface), 2u);
}

TEST(CutNonmanifold, FourCubesAroundAVertexAreFourParts) {
  const ExtractedCells e = extract_cubes({{0, 0, 0}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}});
  EXPECT_EQ(e.report.singular_edges, 6u);
  EXPECT_EQ(parts_of(e.surface), 4u);
}

TEST(CutNonmanifold, CubesThatShareAnEdgeAreJoined) {
  const ExtractedCells e = extract_cubes({{0, 0, 1}, {1, 1, 1}}, Touching::join);
  EXPECT_EQ(e.report.singular_edges, 1u);
  EXPECT_EQ(e.report.singular_vertices, 0u);
  EXPECT_EQ(e.report.middle_vertices, 2u);
  EXPECT_EQ(parts_of(e.surface), 1u);
}

TEST(CutNonmanifold, CubesThatShareAVertexAreNotJoined) {
  const ExtractedCells e = extract_cubes({{0, 0, 0}, {1, 1, 1}}, Touching::join);
  EXPECT_EQ(e.report.singular_vertices, 1u);
  EXPECT_EQ(parts_of(e.surface), 2u);
}

TEST(CutNonmanifold, FourCubesAroundAVertexAreJoinedToOnePart) {
  const ExtractedCells e =
      extract_cubes({{0, 0, 0}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}}, Touching::join);
  EXPECT_EQ(e.report.singular_edges, 6u);
  EXPECT_EQ(e.report.singular_vertices, 1u);
  EXPECT_EQ(parts_of(e.surface), 1u);
}

TEST(CutNonmanifold, CheckerboardIsSeparatedOrJoined) {
  std::vector<Cube> cubes;
  for (int k = 0; k < 27; k += 2) cubes.push_back({k % 3, k / 3 % 3, k / 9});
  const ExtractedCells apart = extract_cubes(cubes, Touching::separate);
  EXPECT_EQ(parts_of(apart.surface), 14u);
  const ExtractedCells joined = extract_cubes(cubes, Touching::join);
  EXPECT_LT(parts_of(joined.surface), 14u);
  EXPECT_EQ(joined.report.singular_edges, apart.report.singular_edges);
}

// Two cubes touch along an edge; slabs above and below, each with a notch, join them round both of
// its ends. Either end is one vertex then, and the edge needs a second copy all the same.
TEST(CutNonmanifold, AnEdgeWithBothEndsInOneFanGetsAMiddleVertex) {
  std::vector<Cube> cubes = {{0, 0, 1}, {1, 1, 1}};
  for (const int z : {0, 2}) {
    cubes.push_back({0, 0, z});
    cubes.push_back({0, 1, z});
    cubes.push_back({1, 1, z});
  }
  const ExtractedCells e = extract_cubes(cubes);
  EXPECT_EQ(e.report.singular_edges, 1u);
  EXPECT_EQ(e.report.singular_vertices, 0u);
  EXPECT_EQ(e.report.middle_vertices, 2u);  // one for each copy, so that none lies inside an edge
  EXPECT_EQ(parts_of(e.surface), 1u);
  // To be joined it needs none: the empty wedges have ends of their own.
  const ExtractedCells joined = extract_cubes(cubes, Touching::join);
  EXPECT_EQ(joined.report.singular_vertices, 2u);
  EXPECT_EQ(joined.report.middle_vertices, 0u);
}

// The same for the space around solids: a cavity that touches itself along an edge.
TEST(CutNonmanifold, EveryChoiceOfEightCubesIsManifold) {
  for (unsigned mask = 1; mask < 256; ++mask) {
    SCOPED_TRACE(mask);
    std::vector<Cube> cubes;
    for (int k = 0; k < 8; ++k) {
      if ((mask >> k & 1) != 0) cubes.push_back({k & 1, k >> 1 & 1, k >> 2 & 1});
    }
    const std::size_t apart = parts_of(extract_cubes(cubes, Touching::separate).surface);
    EXPECT_GE(apart, 1u);
    EXPECT_LE(apart, cubes.size());
    EXPECT_LE(parts_of(extract_cubes(cubes, Touching::join).surface), apart);
  }
}

TEST(CutNonmanifold, RandomChoicesOfCubesAreManifold) {
  std::array<std::size_t, 2> middles{};
  for_each_seed(150, [&](std::uint64_t seed) {
    Random random(seed);
    std::vector<Cube> cubes = {{1, 1, 1}};
    for (int k = 0; k < 27; ++k) {
      const Cube c = {k % 3, k / 3 % 3, k / 9};
      if (k != 13 && random.chance(0.5)) cubes.push_back(c);
    }
    for (std::size_t k = 0; k < 2; ++k) {
      middles[k] += extract_cubes(cubes, kBothWays[k]).report.middle_vertices;
    }
  });
  for (const std::size_t count : middles) EXPECT_GE(count, expected_cases(4u));
}

// Any set of cells of any complex is the solid of a closed manifold.
TEST(CutNonmanifold, RandomCellsOfDegenerateComplexesAreManifold) {
  for (const SoupFamily& family : degenerate_families()) {
    for (std::uint64_t seed = 0; seed < share_of_cases(6u); ++seed) {
      SCOPED_TRACE(family.name + " " + std::to_string(seed));
      Cells cells = cells_of(family.make(seed));
      const auto cover = cover_of(cells);
      Random random(seed);
      std::vector<char> solid(cells.complex.cells.size(), 0);
      for (char& s : solid) s = random.chance(0.4) ? 1 : 0;
      solid[0] = 1;
      std::array<double, 2> volume{};
      for (std::size_t k = 0; k < 2; ++k) {
        ExtractReport report;
        const Surface surface =
            extract_surface(cells.complex, cover, solid, report, {kBothWays[k]});
        expect_closed_manifold(surface.mesh);
        EXPECT_EQ(surface.source.size(), surface.mesh.triangles.size());
        volume[k] = signed_volume(surface.mesh);
      }
      EXPECT_GT(volume[0], 0);
      EXPECT_NEAR(volume[1] / volume[0], 1, 1e-9);
    }
  }
}

}  // namespace
}  // namespace meshrepair
