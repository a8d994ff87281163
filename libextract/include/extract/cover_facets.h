// SPDX-License-Identifier: MIT
// Which facets are covered by input triangles, exactly.
#pragma once

#include <cstddef>
#include <vector>

#include <base/progress.h>
#include <extract/cell_complex.h>

namespace meshrepair {

// What lies on a facet. A facet is covered in full by a triangle or not at all.
struct Cover {
  TriangleId
      triangle;  // the lowest id of the triangles that cover it; invalid: none, it is transparent
  std::int32_t winding = 0;  // sum over them of their orientation against the facet's normal

  [[nodiscard]] bool opaque() const { return triangle.valid(); }
};

// One more triangle on a facet that Cover::triangle covers already.
struct CoverLayer {
  FacetId facet;
  TriangleId triangle;
};

struct CoverReport {
  std::size_t opaque_facets = 0;
  std::size_t split_facets = 0;  // how many cuts it took until no facet was covered in part
  // In a loose complex: facets whose cover was guessed, as cutting them did not come to an end.
  std::size_t guessed_facets = 0;
};

// Decides by predicates on the edges of triangles and facets, never by areas. A facet that a
// triangle covers in part (coplanar triangles, open borders) is split along the triangle's edges;
// its new vertices go into the neighbouring facets too, so the complex stays conforming. In a loose
// complex the predicates hold within the tolerance of its points, and nothing is exact. Frees the
// facets' lists of triangles. `winding` is how each triangle is turned against the normal of its
// plane (Triangle::winding, or that of another orientation of the soup). `layers`, unless null,
// gets what lies on a facet beyond Cover::triangle, in the order of the facets.
[[nodiscard]] IdVector<FacetId, Cover> cover_facets(
    CellComplex& complex, const IdVector<TriangleId, std::int32_t>& winding, CoverReport& report,
    ProgressObserver* progress = nullptr, std::vector<CoverLayer>* layers = nullptr);

}  // namespace meshrepair
