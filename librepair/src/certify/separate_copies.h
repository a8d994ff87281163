// SPDX-License-Identifier: MIT
// Keeping points of one place apart that a file format without indices would join.
#pragma once

#include <cstddef>

#include <base/progress.h>
#include <extract/cut_nonmanifold.h>
#include <mesh/soup.h>
#include <repair/certify.h>

namespace meshrepair::internal {

// How many points have the coordinates of another one.
[[nodiscard]] std::size_t count_copies(const TriangleSoup& mesh);

// Moves each point whose coordinates another point has, too, by a few steps of `spacing`: into the
// solid around it, so that solids that touch no longer do. Where they were joined along an edge, it
// moves the copies on that edge out of the solid, so that they have more than the edge in common.
// Where that makes triangles intersect, as between cavities that touch, other ways are tried. New
// coordinates are such as can be written with `precision`.
void separate_copies(TriangleSoup& mesh, double spacing, Precision precision, Touching touching,
                     ProgressObserver* progress);

}  // namespace meshrepair::internal
