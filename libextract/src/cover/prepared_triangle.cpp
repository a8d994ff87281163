#include "prepared_triangle.h"

#include <algorithm>

#include <exact/predicates.h>

namespace meshrepair::internal {
namespace {

Plane turned(const Plane& p) {
  return make_plane({-p.normal[0], -p.normal[1], -p.normal[2]}, -p.offset);
}

// Two convex polygons in a plane are apart exactly if an edge of one of them separates them. This
// looks at the facet's edges.
bool separated_by_facet(const CellComplex& complex, FacetId facet, const PreparedTriangle& t) {
  bool separated = false;
  complex.for_each_use(facet, [&](UseId u) {
    if (separated) return;
    const PlaneId line = complex.side_plane(complex.uses[u]);
    int inside = 0;  // the side of the line on which the facet lies
    for (UseId w = complex.uses[u].next; w != u && inside == 0; w = complex.uses[w].next) {
      inside = side(complex.vertices[complex.target(complex.uses[w])], line, complex.planes);
    }
    separated = std::all_of(t.corners.begin(), t.corners.end(), [&](const Point& corner) {
      return inside * side(corner, line, complex.planes) <= 0;
    });
  });
  return separated;
}

}  // namespace

PreparedTriangle prepare_triangle(const CleanSoup& soup, TriangleId id) {
  const Triangle& triangle = soup.triangles[id];
  const int axis = dominant_axis(soup.planes[triangle.plane]);
  PreparedTriangle prepared;
  for (std::size_t k = 0; k < 3; ++k) {
    const GridPoint& a = soup.grid_points[triangle.corners[k]];
    const GridPoint& b = soup.grid_points[triangle.corners[(k + 1) % 3]];
    const GridPoint& opposite = soup.grid_points[triangle.corners[(k + 2) % 3]];
    prepared.corners[k] = lattice_point(a);
    prepared.edges[k] = plane_along_axis(a, b, axis);
    if (side(opposite, prepared.edges[k]) < 0) prepared.edges[k] = turned(prepared.edges[k]);
  }
  return prepared;
}

Coverage coverage_of(const CellComplex& complex, FacetId facet, const PreparedTriangle& triangle,
                     std::uint32_t inside) {
  bool any_outside = false;
  for (std::size_t k = 0; k < 3; ++k) {
    if ((inside >> k & 1) != 0) continue;
    const Plane& edge = triangle.edges[k];
    bool within = false;
    bool outside = false;
    complex.for_each_use(facet, [&](UseId u) {
      if (within && outside) return;
      const int s = side(complex.vertices[complex.origin(complex.uses[u])], edge, complex.planes);
      within |= s > 0;
      outside |= s < 0;
    });
    if (!within) return Coverage::none;
    any_outside |= outside;
  }
  if (!any_outside) return Coverage::full;
  return separated_by_facet(complex, facet, triangle) ? Coverage::none : Coverage::part;
}

bool covers_centre(const CellComplex& complex, FacetId facet, const PreparedTriangle& triangle) {
  const std::array<double, 3> centre = facet_centre(complex, facet);
  return std::all_of(triangle.edges.begin(), triangle.edges.end(),
                     [&](const Plane& edge) { return signed_distance(centre, edge) > 0; });
}

bool crosses(const CellComplex& complex, FacetId facet, const Plane& plane) {
  bool above = false;
  bool below = false;
  complex.for_each_use(facet, [&](UseId u) {
    const int s = side(complex.vertices[complex.origin(complex.uses[u])], plane, complex.planes);
    above |= s > 0;
    below |= s < 0;
  });
  return above && below;
}

}  // namespace meshrepair::internal
