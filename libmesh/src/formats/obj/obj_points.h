// The points of an OBJ file.
#pragma once

#include <mesh/mesh_source.h>
#include <mesh/point_io.h>

namespace meshrepair {

// `v` gives a point, and its colour where six numbers or more follow, from 0 to 1; `vn` a normal.
// Normals belong to the points in order, and are none of theirs where there are not as many.
[[nodiscard]] PointReadResult read_obj_points(const MeshSource& source,
                                              const PointReadOptions& options);

}  // namespace meshrepair
