// Taking away what rounding made intersect, place by place.
#pragma once

#include <cstddef>
#include <functional>

#include <base/progress.h>
#include <check/self_intersections.h>
#include <extract/surface.h>

namespace meshrepair {

struct MendOptions {
  double step = 0;   // of the numbers that can be written
  double reach = 0;  // how far the surface may be where an edge was collapsed or turned
  std::function<Vec3d(const Vec3d&)> rounded;  // to the nearest point that can be written
  ProgressObserver* progress = nullptr;        // not owned; no stage is begun
};

// Where two triangles intersect, or one has no area: moves corners of theirs along the normal of
// one, by up to 128 steps, or collapses or turns an edge, whichever leaves the fewest of the
// triangles around it at fault, as long as these become fewer. The surface stays closed and
// manifold, of the same genus. `found` lists its faults, with equal points as one; nothing is done
// where they are very many. Points that move are no points of the input any more. Returns how many
// edits were made. Throws Cancelled. Besides n log n it costs what is near the faults.
std::size_t mend_faults(Surface& surface, const SelfIntersections& found,
                        const MendOptions& options);

}  // namespace meshrepair
