// SPDX-License-Identifier: MIT
// OFF of Geomview, text and binary, and what other programs make of it.
#pragma once

#include <string>
#include <vector>

#include <mesh/mesh_source.h>
#include <mesh/reading.h>

namespace meshrepair {

// Whether the first token is the keyword: OFF with any of the prefixes ST, C, N, 4, n, in any case,
// perhaps with the first count glued to it ("OFF490 662 0").
[[nodiscard]] bool begins_with_off(std::string_view bytes);

// Keyword or not, counts, points, faces; see off_io.cpp for the grammar. Counts are not trusted:
// points and faces end where the file ends, and lines that still are faces after the promised ones
// are read too. A line of a face that is no face is counted as bad and left out. A point whose
// coordinates are not numbers is kept as NaN and counted as bad.
[[nodiscard]] ReadResult read_off(const MeshSource& source);

// The binary kind, for read_off. Points and faces end where the file ends.
[[nodiscard]] ReadResult read_off_binary(const MeshSource& source);

[[nodiscard]] std::string format_off(const TriangleSoup& soup,
                                     const std::vector<std::string>& comments);

}  // namespace meshrepair
