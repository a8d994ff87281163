// SPDX-License-Identifier: MIT
// Which boundary facets become one polygon of the output, and which vertices go.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <extract/boundary.h>
#include <extract/cover_facets.h>
#include <extract/cut_nonmanifold.h>

namespace meshrepair::internal {

// A region is a connected set of boundary facets that are covered by the same triangle of the
// input, or by several of one plane that are all cut, or that are not covered and lie in one plane.
// Its outline may have holes, and may touch itself at vertices and edges.
struct MergedFacets {
  std::vector<std::uint32_t> region;        // of each polygon of the boundary
  std::vector<std::uint32_t> first;         // region r has the polygons list[first[r]] ...
  std::vector<std::uint32_t> list;          // ... to list[first[r + 1] - 1]
  std::vector<std::uint32_t> kept_corners;  // of each region: on its outline, and inside it
  std::vector<char> kept;                   // of each vertex
  std::vector<char> dissolved;              // of each side: inside a region, not on its outline

  [[nodiscard]] std::size_t regions() const { return kept_corners.size(); }
  [[nodiscard]] std::span<const std::uint32_t> polygons_of(std::size_t r) const {
    return {list.data() + first[r], first[r + 1] - first[r]};
  }
  // The side of the outline that follows side s of it.
  [[nodiscard]] std::uint32_t next_on_outline(const Boundary& boundary,
                                              const ManifoldCorners& corners,
                                              std::uint32_t s) const {
    s = boundary.next(s);
    while (dissolved[s] != 0) s = boundary.next(corners.mate[s]);
    return s;
  }
};

// Vertices inside a region go, and so does a vertex at which just two regions meet in a straight
// line; but edges and vertices at which solids touch stay, except for vertices in the middle of
// such an edge. Regions are in the order of the input
// triangles that cover them; those that are not covered come last. Combinatorial: no tolerance is
// involved, but in a loose complex that of its points says what a straight line is. `alone` marks
// polygons that are regions of their own and keep all their vertices; empty is none. What is cut of
// several triangles in one plane is one region if `merges_triangles`.
[[nodiscard]] MergedFacets merge_facets(const CellComplex& complex,
                                        const IdVector<FacetId, Cover>& cover,
                                        const std::vector<char>& solid, const Boundary& boundary,
                                        const ManifoldCorners& corners,
                                        std::span<const char> alone = {},
                                        bool merges_triangles = true);

// Whether a loose point is within its tolerance of the line between two others, and between them.
// Planes say less: two may be so nearly parallel that being near both is not being near their line.
[[nodiscard]] bool lies_between(const Point& point, const Point& a, const Point& b);

}  // namespace meshrepair::internal
