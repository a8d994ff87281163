// Triangles that stand for nothing.
#pragma once

#include <cstddef>

#include <bsp/clean_soup.h>

namespace meshrepair::internal {

// Drops triangles as many copies of which are turned one way as the other, and points that no other
// one has: where all triangles are turned rightly, such are walls without inside, as rounding makes
// them of thin ones. What was closed stays so. Returns how many triangles went. Linear.
std::size_t drop_cancelled(CleanSoup& soup);

}  // namespace meshrepair::internal
