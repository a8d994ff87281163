// SPDX-License-Identifier: MIT
// The points of a PCD file, in all three encodings.
#pragma once

#include <string_view>

#include <mesh/mesh_source.h>
#include <mesh/point_reading.h>

namespace meshrepair {

// By its first lines.
[[nodiscard]] bool begins_with_pcd(std::string_view bytes);

// The fields x, y, z, normal_x, normal_y, normal_z, and rgb or rgba, a colour packed into one
// value. Needs begins_with_pcd(). Compressed points are read all or not at all.
[[nodiscard]] PointReadResult read_pcd_points(const MeshSource& source,
                                              const PointReadOptions& options);

}  // namespace meshrepair
