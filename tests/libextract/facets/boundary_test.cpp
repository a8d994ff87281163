// SPDX-License-Identifier: MIT
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <extract/boundary.h>

#include "complexes.h"
#include "degenerate_soups.h"
#include "each_seed.h"

namespace meshrepair {
namespace {

using namespace testing;

// Volume enclosed by the polygons, in cubic grid steps.
double enclosed_volume(const CellComplex& complex, const Boundary& boundary,
                       const std::vector<char>& solid) {
  TriangleSoup fan;
  for (std::uint32_t p = 0; p < boundary.polygons(); ++p) {
    const auto base = static_cast<std::uint32_t>(fan.points.size());
    const std::uint32_t count = boundary.first[p + 1] - boundary.first[p];
    for (std::uint32_t s = boundary.first[p]; s < boundary.first[p + 1]; ++s) {
      const auto& at = complex.vertices[corner_vertex(complex, boundary, s, solid)].position;
      fan.points.emplace_back(at[0], at[1], at[2]);
    }
    for (std::uint32_t k = 1; k + 1 < count; ++k) {
      fan.triangles.push_back({base, base + k, base + k + 1});
    }
  }
  return signed_volume(fan);
}

std::vector<char> random_labels(const CellComplex& complex, Random& random) {
  const double share = random.real(0.05, 0.95);
  std::vector<char> solid;
  for (std::size_t c = 0; c < complex.cells.size(); ++c) solid.push_back(random.chance(share));
  return solid;
}

// Whatever is solid: the polygons are closed, each runs with the empty side in front, and what they
// enclose is the solid cells. Solid cells at the outer box are closed by it.
TEST(Boundary, EnclosesTheSolidCellsWhicheverTheyAre) {
  for (const SoupFamily& family : degenerate_families()) {
    for_each_seed(4, [&](std::uint64_t seed) {
      SCOPED_TRACE(family.name + " " + std::to_string(seed));
      const Cells cells = cells_of(family.make(seed));
      Random random(seed);
      const std::vector<char> solid = random_labels(cells.complex, random);
      const Boundary boundary = find_boundary(cells.complex, solid);
      ASSERT_EQ(boundary.first.size(), boundary.polygons() + 1);
      ASSERT_EQ(boundary.first.back(), boundary.sides());
      std::map<std::pair<VertexId, VertexId>, int> balance;
      for (std::uint32_t s = 0; s < boundary.sides(); ++s) {
        const VertexId a = corner_vertex(cells.complex, boundary, s, solid);
        const VertexId b = corner_vertex(cells.complex, boundary, boundary.next(s), solid);
        ASSERT_NE(a, b);
        balance[std::minmax(a, b)] += a < b ? 1 : -1;
      }
      for (const auto& [ends, sum] : balance) EXPECT_EQ(sum, 0);
      double volume = 0;
      double whole = 0;
      for (CellId c(0u); c < cells.complex.cells.end_id(); ++c.value) {
        const double v = cell_volume(cells.complex, c);
        whole += v;
        if (solid[c.index()] != 0) volume += v;
      }
      EXPECT_NEAR(enclosed_volume(cells.complex, boundary, solid), volume, 1e-9 * whole);
    });
  }
}

TEST(Boundary, NothingSolidHasNone) {
  const Cells cells = cells_of(cube());
  const Boundary none =
      find_boundary(cells.complex, std::vector<char>(cells.complex.cells.size(), 0));
  EXPECT_EQ(none.polygons(), 0u);
  EXPECT_EQ(none.sides(), 0u);
}

TEST(Boundary, AllSolidIsTheOuterBox) {
  const Cells cells = cells_of(cube());
  const std::vector<char> solid(cells.complex.cells.size(), 1);
  const Boundary boundary = find_boundary(cells.complex, solid);
  for (const FacetId f : boundary.facet) {
    const Facet& facet = cells.complex.facets[f];
    EXPECT_NE(facet.above.valid(), facet.below.valid());
  }
  const GridBox box = outer_box(cells.tree->input);
  EXPECT_DOUBLE_EQ(enclosed_volume(cells.complex, boundary, solid),
                   std::pow(static_cast<double>(box.high.x) - box.low.x, 3));
}

}  // namespace
}  // namespace meshrepair
