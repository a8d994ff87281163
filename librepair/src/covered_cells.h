// The cells of a soup, and what covers their facets.
#pragma once

#include <vector>

#include <extract/cell_complex.h>
#include <extract/cover_facets.h>

namespace meshrepair::internal {

struct CoveredCells {
  CellComplex complex;
  IdVector<FacetId, Cover> cover;
  std::vector<CoverLayer> layers;
};

}  // namespace meshrepair::internal
