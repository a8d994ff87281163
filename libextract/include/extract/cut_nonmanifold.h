// SPDX-License-Identifier: MIT
// Which corners of boundary polygons are one vertex of the output (Gueziec et al. 2001; WM 4.4).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <base/ids.h>
#include <base/progress.h>
#include <extract/boundary.h>

namespace meshrepair {

// The two ways of making a manifold of solids that touch along an edge: apart, or one part that is
// connected there.
enum class Touching { separate, join };

struct ManifoldCorners {
  std::vector<std::uint32_t> mate;    // for each side the one it is joined to
  std::vector<std::uint32_t> vertex;  // output vertex of the corner at the start of each side
  std::vector<std::uint32_t> vertex_corner;  // for each output vertex a side that starts at it
  std::vector<char> singular_side;           // of each side: its edge has more than two polygons
  // Of each output vertex: others lie at its place, or it is an end of a singular side.
  std::vector<char> singular;
  std::size_t singular_edges = 0;     // with more than two polygons
  std::size_t singular_vertices = 0;  // that were copied, once for each fan

  [[nodiscard]] std::size_t vertices() const { return vertex_corner.size(); }
};

// Around an edge the polygons that bound the same wedge are joined, a solid wedge to separate what
// touches there, an empty one to join it; around a vertex each fan of joined polygons gets a copy
// of its own. So solids that touch in a point alone are separate either way: no manifold joins
// them. The result is a closed 2-manifold of polygons, by construction; as an indexed mesh it still
// needs separate_common_edges(). `progress` is asked whether to go on.
[[nodiscard]] ManifoldCorners cut_nonmanifold(const CellComplex& complex, const Boundary& boundary,
                                              const std::vector<char>& solid,
                                              Touching touching = Touching::separate,
                                              ProgressObserver* progress = nullptr);

// Where two wedges at an edge share both end vertices, the edge would have four triangles in an
// indexed mesh: says at which pairs of joined sides to put a vertex in the middle. If one wedge at
// an edge needs one, all get one, as no vertex may lie inside an edge of another triangle.
struct MiddleVertices {
  std::vector<std::uint32_t> of_side;  // its number, or kNone; empty when there are none
  std::size_t count = 0;
};
[[nodiscard]] MiddleVertices separate_common_edges(const CellComplex& complex,
                                                   const Boundary& boundary,
                                                   const ManifoldCorners& corners);

}  // namespace meshrepair
