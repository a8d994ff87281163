// SPDX-License-Identifier: MIT
#include <cmath>

#include <base/error.h>
#include <extract/cell_complex.h>

#include "complex_edit.h"

namespace meshrepair {
namespace {

using Position = std::array<double, 3>;

Position minus(const Position& a, const Position& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Position cross(const Position& a, const Position& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Position& a, const Position& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// Twice the facet's area times its unit normal, the vertices taken relative to the first.
Position area_vector(const CellComplex& complex, FacetId facet) {
  const Facet& f = complex.facets[facet];
  const Position& base = complex.vertices[complex.origin(complex.uses[f.first_use])].position;
  Position sum{};
  Position previous{};
  complex.for_each_use(facet, [&](UseId use) {
    const Position here = minus(complex.vertices[complex.origin(complex.uses[use])].position, base);
    const Position part = cross(previous, here);
    for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += part[axis];
    previous = here;
  });
  return sum;
}

}  // namespace

CellComplex::CellComplex(const CleanSoup& soup, const GridBox& box)
    : planes(soup.planes), soup_(&soup) {
  planes.release_index();
  internal::make_box(*this, box);
}

UseId CellComplex::mate(UseId use, CellId cell) const {
  for (UseId u = edges[uses[use].edge()].first_use; u.valid(); u = uses[u].next_around) {
    if (u != use && bounds(uses[u].facet, cell)) return u;
  }
  throw InternalError("internal error: an edge of a cell has only one facet");
}

FacetMeasure measure_facet(const CellComplex& complex, FacetId facet) {
  const Position v = area_vector(complex, facet);
  const UseId first = complex.facets[facet].first_use;
  const Position& on_it = complex.vertices[complex.origin(complex.uses[first])].position;
  return {0.5 * std::sqrt(dot(v, v)), dot(v, on_it) / 6};
}

double facet_area(const CellComplex& complex, FacetId facet) {
  return measure_facet(complex, facet).area;
}

double cell_volume(const CellComplex& complex, CellId cell) {
  const Facet& first = complex.facets[complex.cells[cell].first_facet];
  const Position base = complex.vertices[complex.origin(complex.uses[first.first_use])].position;
  double sum = 0;
  complex.for_each_facet(cell, [&](FacetId f) {
    const Facet& facet = complex.facets[f];
    const Position& on_it =
        complex.vertices[complex.origin(complex.uses[facet.first_use])].position;
    const double part = dot(area_vector(complex, f), minus(on_it, base));
    sum += facet.below == cell ? part : -part;
  });
  return sum / 6;
}

std::array<double, 3> facet_centre(const CellComplex& complex, FacetId facet) {
  Position sum{};
  double count = 0;
  complex.for_each_use(facet, [&](UseId use) {
    const Position& p = complex.vertices[complex.origin(complex.uses[use])].position;
    for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += p[axis];
    count += 1;
  });
  for (double& x : sum) x /= count;
  return sum;
}

}  // namespace meshrepair
