// SPDX-License-Identifier: MIT
// A skirt and a floor under a scan that is open below: a terrain, a facade laid flat, a relief.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <mesh/soup.h>
#include <points/point_soup.h>

namespace meshrepair {

struct ScanBaseOptions {
  int axis = 2;  // that points up: 0, 1, 2 for x, y, z
  // How far the floor is below the lowest point, in the soup's unit or as a share of the diagonal
  // of its bounding box.
  double depth = 0.05;
  bool is_share = true;
  std::optional<double> floor;  // where it is along the axis instead, below the lowest point
  // Parts of a smaller share of the area than this are no ground, and dropped, and so are those of
  // fewer triangles than this share of the part with the most.
  double smallest_part = 0.01;
  // A rim is that of a scan, and gets a wall, where seen along the axis it is at least this share
  // of its part across. Others are holes.
  double narrowest_rim = 0.5;
};

struct ScanBaseReport {
  double floor = 0;                   // its coordinate along the axis
  std::size_t parts = 0;              // that stand on it
  std::size_t dropped_triangles = 0;  // of smaller parts
  std::size_t skirt_triangles = 0;
};

// From the outer rim of each open part, a wall down to one plane below everything. What is then
// open are holes within the parts, and the floor: flat loops that patch_holes() closes, if it is
// allowed patches as large as they are. The outer rim is that with the largest bounding box seen
// along the axis; a body that is closed but for holes has none, and stays as it is. Throws
// NoSolidError when nothing has a rim, UsageError where the floor is not below all points.
[[nodiscard]] TriangleSoup with_base(const TriangleSoup& soup, const ScanBaseOptions& options,
                                     ScanBaseReport& report);

}  // namespace meshrepair
