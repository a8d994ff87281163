// SPDX-License-Identifier: MIT
// Set operations without trees.
#pragma once

#include <optional>
#include <span>

#include <boolean/boolean.h>

namespace meshrepair::internal {

// The surface that boolean() gives: all solids are joined as one soup, whose triangles know which
// of them have them, and the operation is a function of the winding numbers of each chamber.
// Nothing, and the report without a result, where that takes cells: where the winding numbers of a
// solid contradict each other on the common grid, or extract_mesh() needs cells. Throws InputError
// where a solid is nothing on the grid.
[[nodiscard]] std::optional<Surface> boolean_by_chambers(std::span<const TriangleSoup> solids,
                                                         SetOperation operation,
                                                         const BooleanOptions& options,
                                                         BooleanReport& report);

// The same by the cells between all triangles of all solids: always, and several times as slow.
[[nodiscard]] Surface boolean_by_cells(std::span<const TriangleSoup> solids, SetOperation operation,
                                       const BooleanOptions& options, BooleanReport& report);

}  // namespace meshrepair::internal
