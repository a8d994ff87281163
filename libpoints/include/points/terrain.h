// SPDX-License-Identifier: MIT
// Whether a scan is that of a ground seen from above, which a base makes a solid of (scan_base.h).
#pragma once

#include <mesh/soup.h>

namespace meshrepair {

// Whether the triangles are one sheet seen along the axis, flat beside how wide they are, but no
// plane, and not steep where they end. A scan of one side of a body is steep there: it ends where
// the body turns away. A plane may be the ground as well as a wall, and so may what is flatter than
// the farthest move of a point that was smoothed: noise makes one sheet of the two sides of a thin
// plate. `axis` is 0, 1, 2 for x, y, z.
[[nodiscard]] bool is_terrain(const TriangleSoup& soup, int axis, double farthest_move = 0);

}  // namespace meshrepair
