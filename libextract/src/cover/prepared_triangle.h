// A triangle with the planes through its edges, for asking what part of a facet in its plane it
// covers.
#pragma once

#include <array>
#include <cstdint>

#include <extract/cell_complex.h>

namespace meshrepair::internal {

struct PreparedTriangle {
  std::array<Point, 3> corners;
  std::array<Plane, 3>
      edges;  // across the triangle's plane; the triangle is on the positive side of each
};

[[nodiscard]] PreparedTriangle prepare_triangle(const CleanSoup& soup, TriangleId id);

enum class Coverage { none, part, full };

// How much of the facet, which lies in the triangle's plane, the triangle covers. Touching is none.
// Bit k of `inside` says that the facet is known to be on the inner side of edge k.
[[nodiscard]] Coverage coverage_of(const CellComplex& complex, FacetId facet,
                                   const PreparedTriangle& triangle, std::uint32_t inside = 0);

// Whether the triangle covers the facet's centre, by rounded numbers: a guess.
[[nodiscard]] bool covers_centre(const CellComplex& complex, FacetId facet,
                                 const PreparedTriangle& triangle);

// Whether the facet has vertices strictly on both sides.
[[nodiscard]] bool crosses(const CellComplex& complex, FacetId facet, const Plane& plane);

}  // namespace meshrepair::internal
