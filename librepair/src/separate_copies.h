// Keeping points of one place apart that a file format without indices would join.
#pragma once

#include <cstddef>

#include <bsp/soup.h>
#include <extract/cut_nonmanifold.h>

namespace meshrepair::internal {

// How many points have the coordinates of another one.
[[nodiscard]] std::size_t count_copies(const TriangleSoup& mesh);

// Moves each point whose coordinates another point has, too, by `distance`: into the solid around
// it, so that solids that touch no longer do. Where they were joined along an edge, it moves the
// copies on that edge out of the solid, so that they have more than the edge in common. Returns how
// many were moved.
std::size_t separate_copies(TriangleSoup& mesh, double distance, Touching touching);

}  // namespace meshrepair::internal
