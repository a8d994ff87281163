// SPDX-License-Identifier: MIT
// From one merged region of the boundary to its triangles.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <base/disjoint_sets.h>

#include "facets/merge_facets.h"
#include "triangulate/planar_mesh.h"

namespace meshrepair::internal {

struct PolygonCorner {
  std::array<double, 3> position{};  // only for choosing the shorter diagonal
  bool straight = false;             // its two neighbours and it are in a line
};

// Appends n - 2 triangles (indices into `polygon`, in its orientation) without a degenerate one. At
// least three corners are not straight. Linear time.
void triangulate_convex(std::span<const PolygonCorner> polygon,
                        std::vector<std::array<std::uint32_t, 3>>& triangles);

// A triangle between output vertices. `sides[k]` is the boundary side that runs along its whole
// side from corner k to k + 1, or kNone.
struct RegionTriangle {
  std::array<std::uint32_t, 3> vertices;
  std::array<std::uint32_t, 3> sides;
};

class RegionTriangulator {
 public:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  RegionTriangulator(const CellComplex& complex, const std::vector<char>& solid,
                     const Boundary& boundary, const ManifoldCorners& corners,
                     const MergedFacets& merged);

  // Fills `triangles` with the triangles of a region, whose corners are its kept vertices. False
  // where they cannot be found, which may be so in a loose complex only.
  [[nodiscard]] bool run(std::size_t region, std::vector<RegionTriangle>& triangles);

 private:
  [[nodiscard]] bool try_region(std::size_t region, std::vector<RegionTriangle>& triangles);
  [[nodiscard]] bool trace_triangle(std::size_t region, std::vector<RegionTriangle>& triangles);
  [[nodiscard]] bool fill_mesh(std::size_t region);
  [[nodiscard]] bool add_polygon(std::uint32_t polygon);
  void join_polygons(std::size_t region);
  [[nodiscard]] bool remove_vertices();
  [[nodiscard]] const Point& point_of(std::uint32_t side) const;
  [[nodiscard]] bool is_straight(std::uint32_t side) const;

  struct Diagonal {
    std::uint64_t ends;
    std::uint32_t slot;
  };

  const CellComplex& complex_;
  const std::vector<char>& solid_;
  const Boundary& boundary_;
  const ManifoldCorners& corners_;
  const MergedFacets& merged_;
  DisjointSets sectors_;              // of corners, around a vertex within one region
  std::vector<std::uint32_t> local_;  // of a sector's root: the vertex of the mesh
  std::vector<std::uint32_t> slot_of_side_;
  PlanarMesh mesh_;
  // Scratch of one region.
  std::vector<std::uint32_t> vertex_;  // of each vertex of the mesh its output vertex
  std::vector<PolygonCorner> polygon_corners_;
  std::vector<std::array<std::uint32_t, 3>> pieces_;
  std::vector<Diagonal> diagonals_;
};

}  // namespace meshrepair::internal
