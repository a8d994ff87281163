// SPDX-License-Identifier: MIT
// From a labelled complex to the mesh of its boundary.
#pragma once

#include <cstddef>
#include <vector>

#include <extract/cell_complex.h>
#include <extract/cover_facets.h>
#include <extract/cut_nonmanifold.h>
#include <extract/surface.h>

namespace meshrepair {

struct ExtractOptions {
  Touching touching = Touching::separate;  // what becomes of solids that touch along an edge
  // Whether what is cut of several triangles in one plane may become one triangle; else each one
  // lies in its source.
  bool merges_triangles = true;
  // Of an arrangement: whether edges may have four triangles, where parts of one surface touch, in
  // what is to be repaired once more.
  bool may_touch_itself = false;
  ProgressObserver* progress = nullptr;
};

struct ExtractReport {
  std::size_t boundary_facets = 0;
  std::size_t unmerged_triangles = 0;  // that the facets would have had
  std::size_t regions = 0;             // that the facets were merged into
  std::size_t singular_edges = 0;
  std::size_t singular_vertices = 0;
  std::size_t middle_vertices = 0;  // put into edges at which solids touch, see MiddleVertices
  std::size_t polygons_apart = 0;   // in a loose complex: facets that could not be merged
};

// `solid` has one entry for each cell. Points of the input keep their original coordinates bit for
// bit; new points are rounded from their exact place. The surface has no triangle when nothing is
// solid. It is closed and manifold, of a loose complex too; a loose point that is nearest to a
// point of the input is taken for it.
[[nodiscard]] Surface extract_surface(const CellComplex& complex,
                                      const IdVector<FacetId, Cover>& cover,
                                      const std::vector<char>& solid, ExtractReport& report,
                                      const ExtractOptions& options = {});

}  // namespace meshrepair
