// Moving rounded points by a few units in the last place until triangles no longer touch.
#pragma once

#include <check/self_intersections.h>
#include <extract/surface.h>
#include <repair/certify.h>

namespace meshrepair::internal {

// A point whose exact place is beside an edge may have been rounded onto it, or past it. Moves such
// points, not those of the input, at random but always in the same way, and keeps what lessens the
// number of faults. `found` is what is wrong with the surface.
void nudge_points(Surface& surface, const SelfIntersections& found, Precision precision,
                  ProgressObserver* progress);

}  // namespace meshrepair::internal
