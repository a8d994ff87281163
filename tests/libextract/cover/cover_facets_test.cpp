// SPDX-License-Identifier: MIT
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <base/parallel.h>
#include <extract/cover_facets.h>
#include <mesh/soup_io.h>

#include "cells/check_complex.h"
#include "complexes.h"
#include "degenerate_soups.h"
#include "large_polygons.h"
#include "share_of_cases.h"

namespace meshrepair {
namespace {

using namespace testing;

// A second, slow way to see what lies on a facet: exact, but straight from the definition.
class Judge {
 public:
  Judge(const CellComplex& complex, TriangleId t) : complex_(complex) {
    const CleanSoup& soup = complex.soup();
    const auto& c = soup.triangles[t].corners;
    const std::array<GridPoint, 3> at = {soup.grid_points[c[0]], soup.grid_points[c[1]],
                                         soup.grid_points[c[2]]};
    const int axis = dominant_axis(soup.planes[soup.triangles[t].plane]);
    for (std::size_t k = 0; k < 3; ++k) {
      edges_[k] = plane_along_axis(at[k], at[(k + 1) % 3], axis);
      inside_[k] = side(at[(k + 2) % 3], edges_[k]);
    }
    area_ = 0.5 * norm_of(plane_through(at[0], at[1], at[2]));
  }

  // All of the facet, which lies in the triangle's plane, is in the triangle.
  [[nodiscard]] bool covers(FacetId facet) const {
    bool all = true;
    complex_.for_each_use(facet, [&](UseId u) {
      const Point& p = complex_.vertices[complex_.origin(complex_.uses[u])];
      for (std::size_t k = 0; k < 3 && all; ++k) {
        all = side(p, edges_[k], complex_.planes) * inside_[k] >= 0;
      }
    });
    return all;
  }

  [[nodiscard]] double area() const { return area_; }

 private:
  static double norm_of(const Plane& p) {
    return std::hypot(static_cast<double>(p.normal[0]), static_cast<double>(p.normal[1]),
                      static_cast<double>(p.normal[2]));
  }

  const CellComplex& complex_;
  std::array<Plane, 3> edges_;
  std::array<int, 3> inside_{};
  double area_ = 0;
};

// The facets wholly inside a triangle add up to it, so none is covered in part.
void expect_facets_add_up(const Cells& cells, const IdVector<FacetId, Cover>& cover) {
  const CellComplex& complex = cells.complex;
  const CleanSoup& soup = cells.tree->input;
  std::vector<std::vector<FacetId>> in_plane(complex.planes.size());
  for (FacetId f(0u); f < complex.facets.end_id(); ++f.value) {
    in_plane[complex.facets[f].plane.index()].push_back(f);
  }
  IdVector<FacetId, Cover> expected(complex.facets.size());
  for (TriangleId t(0u); t < soup.triangles.end_id(); ++t.value) {
    const Judge judge(complex, t);
    double covered = 0;
    for (const FacetId f : in_plane[soup.triangles[t].plane.index()]) {
      if (!judge.covers(f)) continue;
      covered += facet_area(complex, f);
      if (!expected[f].opaque()) expected[f].triangle = t;
      expected[f].winding += soup.triangles[t].winding;
    }
    // Areas of needles are sums that cancel: bounded beside the box's size, not beside the area.
    EXPECT_NEAR(covered, judge.area(), 1e-9 * judge.area() + 1e-1) << "triangle " << t.value;
  }
  for (FacetId f(0u); f < complex.facets.end_id(); ++f.value) {
    ASSERT_EQ(cover[f].triangle, expected[f].triangle) << "facet " << f.value;
    ASSERT_EQ(cover[f].winding, expected[f].winding) << "facet " << f.value;
  }
}

TEST(CoverFacets, FacetsOfEachTriangleAddUpToItsArea) {
  for (const SoupFamily& family : degenerate_families()) {
    for (std::uint64_t seed = 0; seed < share_of_cases(6u); ++seed) {
      SCOPED_TRACE(family.name + " " + std::to_string(seed));
      Cells cells = cells_of(family.make(seed));
      CoverReport report;
      const auto cover = cover_facets(cells.complex, own_windings(cells.tree->input), report);
      ASSERT_EQ(cover.size(), cells.complex.facets.size());
      ASSERT_NO_THROW(internal::check_complex(cells.complex));
      expect_facets_add_up(cells, cover);
      std::size_t opaque = 0;
      for (const Cover& c : cover) opaque += c.opaque();
      EXPECT_EQ(report.opaque_facets, opaque);
    }
  }
}

// Far more triangles on one facet than are looked at one by one.
TEST(CoverFacets, ManyTrianglesInOnePlaneCoverTheirArea) {
  Random random(1);
  TriangleSoup soup;
  for (int i = 0; i < 90; ++i) {
    const auto corner = [&] { return Vec3d(random.integer(0, 40), random.integer(0, 40), 0); };
    const Vec3d a = corner();
    const Vec3d b = corner();
    add_triangle(soup, a, b, corner());
  }
  Cells cells = cells_of(soup);
  const auto cover = cover_of(cells);
  internal::check_complex(cells.complex);
  expect_facets_add_up(cells, cover);
}

TEST(CoverFacets, TheNumberOfThreadsDoesNotMatter) {
  const TriangleSoup soup = random_soup(300, 1 << 20, 1);
  const auto cover_all = [&] {
    Cells cells = cells_of(soup);
    CoverReport report;
    std::vector<CoverLayer> layers;
    const auto cover =
        cover_facets(cells.complex, own_windings(cells.tree->input), report, nullptr, &layers);
    EXPECT_GT(report.split_facets, 1000u);
    std::vector<std::uint32_t> all;
    for (const Cover& c : cover)
      all.insert(all.end(), {c.triangle.value, std::uint32_t(c.winding)});
    for (const CoverLayer& l : layers) all.insert(all.end(), {l.facet.value, l.triangle.value});
    for (const Use& u : cells.complex.uses) all.insert(all.end(), {u.facet.value, u.next.value});
    return all;
  };
  const auto many = cover_all();
  const ThreadLimit one(1);
  EXPECT_EQ(cover_all(), many);
}

TEST(CoverFacets, SplittingKeepsCellsConvexAndTheirVolumes) {
  for (const SoupFamily& family : degenerate_families()) {
    SCOPED_TRACE(family.name);
    Cells cells = cells_of(family.make(3));
    std::vector<double> before;
    for (CellId c(0u); c < cells.complex.cells.end_id(); ++c.value) {
      before.push_back(cell_volume(cells.complex, c));
    }
    (void)cover_of(cells);
    expect_convex_cells(cells.complex);
    for (CellId c(0u); c < cells.complex.cells.end_id(); ++c.value) {
      const double volume = cell_volume(cells.complex, c);
      EXPECT_NEAR(volume, before[c.index()], 1e-7 * std::abs(volume) + 1e12);
    }
  }
}

TEST(CoverFacets, AClosedMeshNeedsNoSplits) {
  Cells cells = cells_of(noisy_sphere(500, 0.15, 1));
  CoverReport report;
  (void)cover_facets(cells.complex, own_windings(cells.tree->input), report);
  EXPECT_EQ(report.split_facets, 0u);
  EXPECT_GT(report.opaque_facets, 500u);
}

// Each side of the cube is one facet, and neither of its triangles covers all of it.
TEST(CoverFacets, SidesAreSplitAlongTheirDiagonals) {
  TriangleSoup soup = cube();
  soup.triangles.pop_back();
  Cells cells = cells_of(soup);
  CoverReport report;
  const auto cover = cover_facets(cells.complex, own_windings(cells.tree->input), report);
  EXPECT_EQ(report.split_facets, 6u);
  EXPECT_EQ(report.opaque_facets, 11u);
  expect_facets_add_up(cells, cover);
}

// Once the caps were fans, whose triangles lay on each other in millions of pieces.
TEST(CoverFacets, LargeConcaveFaceIsSplitAFewTimesForEachOfItsCorners) {
  const std::vector<Vec3d> base = koch_curve(5, 5);
  ASSERT_GT(base.size(), 5000u);
  Cells cells = cells_of(read_soup(prism_off(base), "prism.off").soup);
  CoverReport report;
  (void)cover_facets(cells.complex, own_windings(cells.tree->input), report);
  EXPECT_GT(report.opaque_facets, 4 * base.size());
  EXPECT_LT(report.split_facets, 16 * base.size());
}

TEST(CoverFacets, OppositeTrianglesOnOneFacetCancelAndAreOpaque) {
  TriangleSoup soup = cube();
  // The same side with the other diagonal, turned round.
  add_triangle(soup, {0, 0, 0}, {0, 1, 0}, {0, 0, 1});
  add_triangle(soup, {0, 1, 1}, {0, 0, 1}, {0, 1, 0});
  Cells cells = cells_of(soup);
  const auto cover = cover_of(cells);
  expect_facets_add_up(cells, cover);
  int cancelled = 0;
  for (const Cover& c : cover) cancelled += c.opaque() && c.winding == 0;
  EXPECT_EQ(cancelled, 4);
}

TEST(CoverFacets, ListsOfTrianglesAreFreed) {
  Cells cells = cells_of(cube());
  (void)cover_of(cells);
  EXPECT_TRUE(cells.complex.facet_triangles.empty());
  for (const Facet& f : cells.complex.facets) EXPECT_EQ(f.triangle_count, 0u);
}

}  // namespace
}  // namespace meshrepair
