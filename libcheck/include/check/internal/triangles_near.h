// Which triangles of a soup are near a few boxes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <check/box_tree.h>
#include <mesh/soup.h>

namespace meshrepair::internal {

// The triangles whose boxes, widened by `reach`, meet one of these, ascending; of two that are not
// finite nothing is said. Linear in the soup, with a small factor. The same for any number of
// threads.
[[nodiscard]] std::vector<std::uint32_t> triangles_near(const TriangleSoup& soup,
                                                        std::span<const Box> boxes, double reach);

}  // namespace meshrepair::internal
