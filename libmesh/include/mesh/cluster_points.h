// SPDX-License-Identifier: MIT
// Fewer triangles that look alike from afar: for pictures, not for solids.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <mesh/soup.h>

namespace meshrepair {

struct ClusteredSoup {
  TriangleSoup soup;                  // its points are points of the mesh that was given
  std::vector<std::uint32_t> source;  // of each triangle, the one it was; ascending
};

// Lays a grid over the mesh, and joins the points within each cell: all move onto the one that is
// nearest to their middle. Triangles with two corners in a cell go, and so do those that came to
// have the corners of another one, the same way round. Points of triangles that are `fixed` (one
// entry a triangle) stay where they are. The cells are as small as can be found quickly for no more
// than `most` triangles beside the fixed ones; where these hold so many others that even the
// largest cells leave more, every so many of those are left. Triangles that are not finite go.
// Near linear. The same result each time.
[[nodiscard]] ClusteredSoup cluster_points(const TriangleSoup& soup, std::span<const char> fixed,
                                           std::size_t most);

}  // namespace meshrepair
