// PLY, ASCII and binary of both byte orders.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <mesh/mesh_source.h>
#include <mesh/soup_io.h>

namespace meshrepair {

// Points are the properties x, y, z of the element `vertex`; faces are the list vertex_indices (or
// vertex_index, or the only list) of the element `face`, and the strips of `tristrips`. Other
// elements and properties, of any type and anywhere, are passed over. The header's counts and the
// lengths of lists are checked against the bytes: elements end where the file ends. In ASCII a line
// that cannot be read is a bad face, or a bad point kept as NaN; in a binary file nothing can be
// read behind it.
[[nodiscard]] ReadResult read_ply(const MeshSource& source);

// Coordinates in double. `sources` has a number for each triangle, written as the property
// `int source_triangle` of its face, with all ones as -1; if it is empty there is no such property.
[[nodiscard]] std::string format_ply_binary(const TriangleSoup& soup,
                                            const std::vector<std::string>& comments,
                                            std::span<const std::uint32_t> sources);
[[nodiscard]] std::string format_ply_ascii(const TriangleSoup& soup,
                                           const std::vector<std::string>& comments,
                                           std::span<const std::uint32_t> sources);

}  // namespace meshrepair
