// SPDX-License-Identifier: MIT
// Smoothing of noisy points: each onto the surface that its neighbours suggest.
#pragma once

#include "sift_points.h"

namespace meshrepair {

// Moves each point along the normal at it onto the quadratic surface of weighted least squares
// through its neighbours, as often as options.project says, all points at once each time; then
// drops points that are too near to each other. The cloud's spacing and neighbourhoods are left as
// those of the points where they were, and must be found anew. Returns the farthest move. Throws
// Cancelled.
double project_points(SiftedCloud& cloud, const PointSoupOptions& options);

}  // namespace meshrepair
