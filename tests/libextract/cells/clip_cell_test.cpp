// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <extract/clip_cell.h>

#include "cells/check_complex.h"
#include "complexes.h"

namespace meshrepair {
namespace {

using namespace testing;

struct Counts {
  std::size_t vertices = 0, edges = 0, facets = 0;
  bool operator==(const Counts&) const = default;
};

void PrintTo(const Counts& c, std::ostream* out) {
  *out << "V " << c.vertices << " E " << c.edges << " F " << c.facets;
}

// The box from 0 to 4 in every direction, and planes to cut it by.
class ClipCube : public ::testing::Test {
 protected:
  PlaneId plane(const std::array<std::int64_t, 3>& normal, std::int64_t offset) {
    return complex_.planes.append(make_plane(normal, offset));
  }

  CellId clip(PlaneId by, CellId cell = CellId(0u)) {
    const CellId below = clipper_.clip(cell, by);
    EXPECT_NO_THROW(internal::check_complex(complex_));
    return below;
  }

  [[nodiscard]] Counts counts(CellId cell) const {
    Counts c;
    std::set<EdgeId> edges;
    complex_.for_each_facet(cell, [&](FacetId f) {
      ++c.facets;
      complex_.for_each_use(f, [&](UseId u) { edges.insert(complex_.uses[u].edge()); });
    });
    c.vertices = vertices_of(complex_, cell).size();
    c.edges = edges.size();
    EXPECT_EQ(c.vertices + c.facets, c.edges + 2);
    return c;
  }

  CleanSoup soup_;
  CellComplex complex_{soup_, {{0, 0, 0}, {4, 4, 4}}};
  ExactEngine engine_;
  Clipper clipper_{complex_, engine_};
};

constexpr CellId kAbove(0u);

TEST_F(ClipCube, ThroughFourFaces) {
  const CellId below = clip(plane({1, 0, 0}, -1));
  EXPECT_EQ(counts(kAbove), (Counts{8, 12, 6}));
  EXPECT_EQ(counts(below), (Counts{8, 12, 6}));
  EXPECT_DOUBLE_EQ(cell_volume(complex_, kAbove), 48);
  EXPECT_DOUBLE_EQ(cell_volume(complex_, below), 16);
  EXPECT_EQ(clipper_.report().fallbacks(), 0u);
}

TEST_F(ClipCube, ThroughTwoOppositeEdges) {
  const CellId below = clip(plane({1, 1, 0}, -4));
  EXPECT_EQ(counts(kAbove), (Counts{6, 9, 5}));
  EXPECT_EQ(counts(below), (Counts{6, 9, 5}));
  EXPECT_DOUBLE_EQ(cell_volume(complex_, below), 32);
  EXPECT_EQ(complex_.vertices.size(), 8u);
  EXPECT_EQ(clipper_.report().fallbacks(), 0u);
}

TEST_F(ClipCube, ThroughThreeVertices) {
  const CellId below = clip(plane({1, 1, 1}, -4));
  EXPECT_EQ(counts(below), (Counts{4, 6, 4}));
  EXPECT_EQ(counts(kAbove), (Counts{7, 12, 7}));
  EXPECT_DOUBLE_EQ(cell_volume(complex_, below), 64.0 / 6);
  EXPECT_EQ(complex_.vertices.size(), 8u);
  EXPECT_EQ(clipper_.report().fallbacks(), 0u);
}

TEST_F(ClipCube, ThroughTheMiddlesOfSixEdges) {
  const CellId below = clip(plane({1, 1, 1}, -6));
  EXPECT_EQ(counts(below), (Counts{10, 15, 7}));
  EXPECT_EQ(counts(kAbove), (Counts{10, 15, 7}));
  EXPECT_DOUBLE_EQ(cell_volume(complex_, below), 32);
  EXPECT_EQ(clipper_.report().fallbacks(), 0u);
}

TEST_F(ClipCube, ThroughTwoVerticesAndTwoEdges) {
  const CellId below = clip(plane({2, -1, -1}, 0));
  EXPECT_EQ(counts(below), (Counts{7, 11, 6}));
  EXPECT_EQ(counts(kAbove), (Counts{7, 11, 6}));
  EXPECT_DOUBLE_EQ(cell_volume(complex_, below), 32);
  EXPECT_EQ(clipper_.report().fallbacks(), 0u);
}

TEST_F(ClipCube, ThroughOneEdgeAndTwoFaces) {
  const CellId below = clip(plane({2, 0, -1}, 0));  // holds the edge x = z = 0
  EXPECT_EQ(counts(below), (Counts{6, 9, 5}));
  EXPECT_EQ(counts(kAbove), (Counts{8, 12, 6}));
  EXPECT_DOUBLE_EQ(cell_volume(complex_, below), 16);
  EXPECT_EQ(clipper_.report().fallbacks(), 0u);
}

TEST_F(ClipCube, PartAboveKeepsItsIdAndTheNewFacetPointsThere) {
  const PlaneId by = plane({0, 0, 1}, -1);
  const CellId below = clip(by);
  const FacetId lid(complex_.facets.size() - 1);
  EXPECT_EQ(complex_.facets[lid].plane, by);
  EXPECT_EQ(complex_.facets[lid].above, kAbove);
  EXPECT_EQ(complex_.facets[lid].below, below);
  EXPECT_DOUBLE_EQ(cell_volume(complex_, kAbove), 48);
}

TEST_F(ClipCube, NeighboursGetTheNewVerticesToo) {
  const CellId low = clip(plane({0, 0, 1}, -2));
  // Across the cut between the two halves, in the upper one only.
  const CellId part = clip(plane({1, 0, 0}, -2), kAbove);
  EXPECT_EQ(counts(low), (Counts{10, 15, 7}));
  EXPECT_EQ(counts(part), (Counts{8, 12, 6}));
  EXPECT_EQ(counts(kAbove), (Counts{8, 12, 6}));
  EXPECT_EQ(clipper_.report().fallbacks(), 0u);
}

TEST_F(ClipCube, ManyPlanesThroughOneVertexAndOneEdgeKeepCellsSound) {
  std::vector<PlaneId> planes;
  for (std::int64_t k = 1; k < 8; ++k) {
    planes.push_back(plane({k, -8 + k, 0}, 0));      // all hold the edge x = y = 0
    planes.push_back(plane({k, 8 - k, -4}, 0));      // all hold the vertex at the origin
    planes.push_back(plane({k, 8 - k, 8}, -4 * 8));  // all hold the vertex (0, 0, 4) ... or near it
  }
  double volume = 0;
  for (const PlaneId p : planes) {
    const std::size_t cells = complex_.cells.size();
    for (std::uint32_t c = 0; c < cells; ++c) {
      int above = 0, below = 0;
      for (const VertexId v : vertices_of(complex_, CellId(c))) {
        const int s = side(complex_.vertices[v], p, complex_.planes);
        above += s > 0;
        below += s < 0;
      }
      if (above > 0 && below > 0) (void)clipper_.clip(CellId(c), p);
    }
  }
  internal::check_complex(complex_);
  expect_convex_cells(complex_);
  for (CellId c(0u); c < complex_.cells.end_id(); ++c.value) volume += cell_volume(complex_, c);
  EXPECT_NEAR(volume, 64, 1e-9);
  EXPECT_GT(complex_.cells.size(), 50u);
  EXPECT_EQ(clipper_.report().fallbacks(), 0u);
}

// No cut at all, geometrically: the topology is valid all the same, and the report says so.
TEST_F(ClipCube, PlanesThatOnlyTouchAreReported) {
  for (const PlaneId by :
       {plane({1, 0, 0}, 0), plane({1, 0, 0}, -4), plane({1, 1, 0}, 0), plane({1, 1, 0}, -8),
        plane({1, 1, 1}, 0), plane({1, 1, 1}, -12), plane({1, 0, 0}, -9), plane({1, 0, 0}, 9)}) {
    const std::size_t before = clipper_.report().fallbacks();
    (void)clip(by);
    EXPECT_GT(clipper_.report().fallbacks(), before);
  }
}

}  // namespace
}  // namespace meshrepair
