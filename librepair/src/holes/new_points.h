// SPDX-License-Identifier: MIT
// Points that are put into a clean soup.
#pragma once

#include <vector>

#include <bsp/clean_soup.h>

namespace meshrepair::internal {

// For each place, in grid coordinates, the nearest point of the grid: one that the soup has
// already, or a new one.
[[nodiscard]] std::vector<PointId> add_points(CleanSoup& soup, const std::vector<Vec3d>& places);

}  // namespace meshrepair::internal
