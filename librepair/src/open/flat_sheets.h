// Sheets that lie in one plane, but for the rounding of their coordinates.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <bsp/clean_soup.h>
#include <mesh/edge_table.h>

namespace meshrepair::internal {

// The original place of the point, in grid units.
[[nodiscard]] Vec3d original_place(const CleanSoup& soup, PointId point);

// Whether all points, of which there are some, lie in one plane, each off by no more than
// `rounding`: the plane of three that are far from each other tells.
[[nodiscard]] bool is_flat(const std::vector<Vec3d>& points, double rounding);

}  // namespace meshrepair::internal
