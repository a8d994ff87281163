// Soups that are flat, as far as the grid can tell.
#pragma once

#include <bsp/clean_soup.h>

namespace meshrepair::internal {

// Whether all points are so near to one plane, that of least squares, that they may have lain in it
// before they were put on the grid.
[[nodiscard]] bool is_flat(const CleanSoup& soup);

}  // namespace meshrepair::internal
