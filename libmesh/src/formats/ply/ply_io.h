// SPDX-License-Identifier: MIT
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
#include <mesh/soup_extras.h>

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

// Coordinates in double. Sources are the property `int source_triangle` of faces. Attributes are
// properties of points where each point has one value, else of faces where each triangle has one;
// texture coordinates with seams are lists `texcoord` of faces. Of other colours the first of each
// point is written; normals with creases, and groups, are left out. Materials are the property
// `int material_index`, whose names stand in comments; their textures, as other programs have them,
// `int texnumber` and comments `TextureFile`. A missing number is NaN, or 0 where that cannot be.
[[nodiscard]] std::string format_ply_binary(const TriangleSoup& soup, const SoupExtras& extras);
[[nodiscard]] std::string format_ply_ascii(const TriangleSoup& soup, const SoupExtras& extras);

// Whether the file begins as a PLY whose header promises points and no faces. A header that cannot
// be understood promises nothing.
[[nodiscard]] bool is_ply_of_points(const MeshSource& source);

// The properties x, y, z, nx, ny, nz, red, green, blue of the element `vertex`; what stands behind
// it is not looked at.
[[nodiscard]] PointReadResult read_ply_points(const MeshSource& source,
                                              const PointReadOptions& options);

}  // namespace meshrepair
