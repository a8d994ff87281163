// Smoothing of noisy points: each onto the surface that its neighbours suggest.
#pragma once

#include <bsp/progress.h>

#include "sift_points.h"

namespace meshrepair {

// Moves each point along the normal at it onto the quadratic surface of weighted least squares
// through its neighbours, so many times, all points at once each time. The cloud's spacing and
// neighbourhoods are those of the points where they were. Returns the farthest move. Throws
// Cancelled.
double project_points(SiftedCloud& cloud, int times, ProgressObserver* progress);

}  // namespace meshrepair
