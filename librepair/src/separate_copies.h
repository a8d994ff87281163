// Keeping points of one place apart that a file format without indices would join.
#pragma once

#include <cstddef>

#include <bsp/soup.h>

namespace meshrepair::internal {

// How many points have the coordinates of another one.
[[nodiscard]] std::size_t count_copies(const TriangleSoup& mesh);

// Moves each point whose coordinates another point has, too, into the solid around it by
// `distance`, so that solids that touch no longer do. Returns how many were moved.
std::size_t separate_copies(TriangleSoup& mesh, double distance);

}  // namespace meshrepair::internal
