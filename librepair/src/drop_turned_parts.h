// Taking away parts that rounding turned inside out or flattened.
#pragma once

#include <cstddef>
#include <vector>

#include <extract/surface.h>

namespace meshrepair::internal {

// Parts are connected across edges. Those whose signed volume has another sign than it had with the
// points `before` go: they are no larger than what the numbers can tell apart. Returns how many; 0
// too when all would have to go.
std::size_t drop_turned_parts(Surface& surface, const std::vector<Vec3d>& before);

}  // namespace meshrepair::internal
