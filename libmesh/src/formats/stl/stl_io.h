// SPDX-License-Identifier: MIT
// STL, binary and ASCII.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <mesh/mesh_source.h>
#include <mesh/reading.h>

namespace meshrepair {

inline constexpr std::size_t kStlHeaderText = 80;  // of binary files
inline constexpr std::size_t kStlHeaderSize = 84;  // with the number of triangles
inline constexpr std::size_t kStlTriangleSize = 50;

// Whether the bytes are a binary STL beyond doubt: the count in the header fits the size.
[[nodiscard]] bool is_binary_stl(std::string_view bytes);

// The number of triangles is what the bytes hold, (size - 84) / 50 rounded down; the header's count
// is only compared with it. Throws InputError when there is not one triangle.
[[nodiscard]] ReadResult read_stl_binary(const MeshSource& source);

// Only the tokens count, not the lines: keywords in any case, any white space, any number of
// solids, with or without a `solid` line. A loop of more than three vertices is a polygon. A facet
// in which the file ends is left out. A vertex whose coordinates are not numbers is kept as NaN and
// counted as a bad point; "nan", "inf", "-1.#IND" and the like are numbers. Solids of different
// names are groups; one name alone is kept for another ASCII STL.
[[nodiscard]] ReadResult read_stl_ascii(const MeshSource& source);

// Throws OutputError if a finite coordinate is beyond the range of float32.
// `attributes` may be null; their colours, or else groups that are numbers, go into the attribute
// words.
[[nodiscard]] std::string format_stl_binary(const TriangleSoup& soup, const Attributes* attributes);
// Each group becomes a solid of its name, in the order of the names, triangles without one a last.
// `attributes` may be null.
[[nodiscard]] std::string format_stl_ascii(const TriangleSoup& soup, const Attributes* attributes);

// The attribute words of these groups. Empty where a name is no number that a word can be.
[[nodiscard]] std::vector<std::uint16_t> stl_region_words(const TriangleLabels& groups);

// Unit normal, counter-clockwise; 0 for a triangle without area or not finite.
[[nodiscard]] Vec3d stl_normal(const Vec3d& a, const Vec3d& b, const Vec3d& c);

}  // namespace meshrepair
