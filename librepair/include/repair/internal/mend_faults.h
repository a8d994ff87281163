// SPDX-License-Identifier: MIT
// Taking away what rounding made intersect or lose its area, place by place.
#pragma once

#include <cstddef>
#include <functional>

#include <base/progress.h>
#include <check/self_intersections.h>
#include <extract/surface.h>

namespace meshrepair::internal {

// How far points are moved at most, in steps.
inline constexpr double kMostMendShift = 128;

struct MendOptions {
  double step = 0;    // of the numbers that can be written
  double within = 0;  // how far the surface may be where an edge was collapsed or turned
  std::function<Vec3d(const Vec3d&)> rounded;  // to the nearest point that can be written
  ProgressObserver* progress = nullptr;        // not owned; no stage is begun
};

// Where two triangles intersect, or one has no area: moves corners of theirs along the normal of
// one, by up to kMostMendShift steps, or collapses or turns an edge, whichever leaves the fewest of
// the triangles around it at fault, as long as these become fewer. The surface stays closed and
// manifold, of the same genus. `found` lists its faults, with equal points as one; nothing is done
// where they are very many. Points that move are no points of the input any more. Returns how many
// edits were made. Throws Cancelled. Besides n log n it costs what is near the faults.
std::size_t mend_faults(Surface& surface, const SelfIntersections& found,
                        const MendOptions& options);

// Makes the two ends of an edge one where rounding has brought them to one place, and takes away
// the two triangles at the edge, which have no area. Leaves the edges where the surface would not
// stay a closed manifold of the same genus. Returns how many points went. `surface` is closed and
// manifold; linear in its size.
std::size_t join_ends(Surface& surface);

}  // namespace meshrepair::internal
