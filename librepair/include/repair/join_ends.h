// Edges that have no length.
#pragma once

#include <cstddef>

#include <extract/surface.h>

namespace meshrepair {

// Makes the two ends of an edge one where rounding has brought them to one place, and takes away
// the two triangles at the edge, which have no area. Leaves the edges where the surface would not
// stay a closed manifold of the same genus. Returns how many points went. `surface` is closed and
// manifold; linear in its size.
std::size_t join_ends(Surface& surface);

}  // namespace meshrepair
