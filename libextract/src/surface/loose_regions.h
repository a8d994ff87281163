// SPDX-License-Identifier: MIT
// Regions that are no polygons, as there are where predicates were wrong: found before and after
// they are triangulated.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "facets/merge_facets.h"

namespace meshrepair::internal {

// Marks the polygons of regions that have no outline, or one with fewer than three corners, or a
// polygon of two sides, unless they are alone already. False when there were none.
[[nodiscard]] bool set_apart_odd_regions(const Boundary& boundary, const ManifoldCorners& corners,
                                         const MergedFacets& merged, std::vector<char>& alone);

// In a loose complex two edges may have the same ends. As an indexed mesh cannot tell them apart,
// each such edge of the outlines that is not split by a middle vertex yet gets one.
void separate_common_ends(const Boundary& boundary, const ManifoldCorners& corners,
                          const MergedFacets& merged, MiddleVertices& middles);

// The regions, each once, of triangles that have a corner twice, or an edge that is not one of just
// two triangles that pass it in opposite directions.
[[nodiscard]] std::vector<std::uint32_t> conflicting_regions(
    std::span<const std::array<std::uint32_t, 3>> triangles,
    std::span<const std::uint32_t> region_of_triangle);

}  // namespace meshrepair::internal
