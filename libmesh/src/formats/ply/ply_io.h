// PLY, ASCII and binary of both byte orders: meshes and points.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <mesh/mesh_source.h>
#include <mesh/point_reading.h>
#include <mesh/reading.h>

namespace meshrepair {

// "ply" alone on the first line.
[[nodiscard]] bool begins_with_ply(std::string_view bytes);

// Points are the properties x, y, z of the element `vertex`; faces are the list vertex_indices (or
// vertex_index, or the only list) of the element `face`, and the strips of `tristrips`. Other
// elements and properties, of any type and anywhere, are passed over. The header's counts and the
// lengths of lists are checked against the bytes: elements end where the file ends. In ASCII a line
// that cannot be read is a bad face, or a bad point kept as NaN; in a binary file nothing can be
// read behind it.
[[nodiscard]] ReadResult read_ply(const MeshSource& source);

// Whether the file begins as a PLY whose header promises points and no faces. A header that cannot
// be understood promises nothing.
[[nodiscard]] bool is_ply_of_points(const MeshSource& source);

// The properties x, y, z, nx, ny, nz, red, green, blue of the element `vertex`; what stands behind
// it is not looked at.
[[nodiscard]] PointReadResult read_ply_points(const MeshSource& source,
                                              const PointReadOptions& options);

}  // namespace meshrepair
