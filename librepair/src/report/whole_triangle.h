// Which triangles of a result are whole ones of the input.
#pragma once

#include <cstddef>

#include <extract/surface.h>
#include <mesh/soup.h>

namespace meshrepair::internal {

// Triangle t of the surface, which names a source, has its corners, as given or in single
// precision.
[[nodiscard]] bool has_corners_of_source(const TriangleSoup& soup, const Surface& surface,
                                         std::size_t t);

}  // namespace meshrepair::internal
