// Input points where everything was decided.
#pragma once

#include <cstddef>

#include <check/internal/known_intersections.h>
#include <exact/grid.h>
#include <extract/surface.h>

namespace meshrepair::internal {

// Of triangles that intersect, moves the input's corners onto the grid, then those of triangles
// that the moves made intersect, until none do or all their corners are there. Cut points are exact
// up to the rounding of doubles and stay, so it ends with the arrangement that was decided on.
// Points in one place move together. Returns how many moved; `known` knows the outcome. Throws
// Cancelled.
std::size_t settle_input_points(Surface& surface, const Grid& grid, KnownIntersections& known);

}  // namespace meshrepair::internal
