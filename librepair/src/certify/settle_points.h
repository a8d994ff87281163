// SPDX-License-Identifier: MIT
// Where points come to lie that rounding moved: input points where everything was decided, others a
// few units in the last place beside it.
#pragma once

#include <cstddef>

#include <check/internal/known_intersections.h>
#include <check/self_intersections.h>
#include <exact/grid.h>
#include <extract/surface.h>
#include <repair/certify.h>

namespace meshrepair::internal {

// Of triangles that intersect, moves the input's corners onto the grid, then those of triangles
// that the moves made intersect, until none do or all their corners are there. Cut points are exact
// up to the rounding of doubles and stay, so it ends with the arrangement that was decided on.
// Points in one place move together. Returns how many moved; `known` knows the outcome. Throws
// Cancelled.
std::size_t settle_input_points(Surface& surface, const Grid& grid, KnownIntersections& known);

// A point whose exact place is beside an edge may have been rounded onto it, or past it. Moves such
// points, not those of the input, at random but always in the same way, and keeps what lessens the
// number of faults. `found` is what is wrong with the surface.
void nudge_points(Surface& surface, const SelfIntersections& found, Precision precision,
                  ProgressObserver* progress);

}  // namespace meshrepair::internal
