// The points of a PLY file.
#pragma once

#include <mesh/mesh_source.h>
#include <mesh/point_io.h>

namespace meshrepair {

// Whether the file begins as a PLY whose header promises points and no faces. A header that cannot
// be understood promises nothing.
[[nodiscard]] bool is_ply_of_points(const MeshSource& source);

// The properties x, y, z, nx, ny, nz, red, green, blue of the element `vertex`; what stands behind
// it is not looked at.
[[nodiscard]] PointReadResult read_ply_points(const MeshSource& source,
                                              const PointReadOptions& options);

}  // namespace meshrepair
