// SPDX-License-Identifier: MIT
// The point cloud: what the readers of points return and the local triangulation takes.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <mesh/soup.h>

namespace meshrepair {

// Points in the units of the file. Nothing is promised of them: they may repeat, and not be finite.
// `normals` and `colours` are empty, or have an entry for each point; a normal may have any length,
// 0 and not finite among them: then it says nothing.
struct PointCloud {
  std::vector<Vec3d> points;
  std::vector<Vec3d> normals;
  std::vector<std::array<std::uint8_t, 3>> colours;  // red, green, blue
};

}  // namespace meshrepair
