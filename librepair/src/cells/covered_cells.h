// SPDX-License-Identifier: MIT
// The cells of a soup, and what covers their facets.
#pragma once

#include <vector>

#include <base/stage_meter.h>
#include <bsp/clean_soup.h>
#include <bsp/tree.h>
#include <extract/cell_complex.h>
#include <extract/cover_facets.h>
#include <repair/repair_options.h>
#include <repair/repair_report.h>

namespace meshrepair::internal {

struct CoveredCells {
  CellComplex complex;
  IdVector<FacetId, Cover> cover;
  std::vector<CoverLayer> layers;
};

// Divides space along the triangles.
[[nodiscard]] Tree divide_space(CleanSoup clean, const RepairOptions& options, RepairReport& report,
                                StageMeter& meter);

// The cells of the tree, with `winding` of each triangle against the normal of its plane. The tree
// has to outlive them.
[[nodiscard]] CoveredCells make_cells(const Tree& tree,
                                      const IdVector<TriangleId, std::int32_t>& winding,
                                      const RepairOptions& options, RepairReport& report,
                                      StageMeter& meter);

}  // namespace meshrepair::internal
