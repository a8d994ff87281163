// SPDX-License-Identifier: MIT
// Points as lines of numbers: XYZ, PTS and PWN, and how such lines are laid out: what separates
// numbers, and what columns are called. See point_io.h.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include <mesh/mesh_source.h>
#include <mesh/point_reading.h>

#include "formats/common/point_columns.h"

namespace meshrepair {

enum class Separators {
  blanks,
  commas,      // and semicolons
  semicolons,  // commas are decimal ones
};

// Told by the first lines.
[[nodiscard]] Separators find_separators(std::string_view bytes);

// The text with blanks in place of other separators.
[[nodiscard]] std::string with_blanks(std::string_view bytes, Separators separators);

// The line of names that tables may begin with.
struct ColumnNames {
  std::size_t end = 0;                                 // where the line ends; 0: there is none
  std::array<std::size_t, 3> coordinates = {0, 1, 2};  // the columns of x, y and z
};

// Of a text with blanks. There are none unless all three are, and as many as there are columns:
// words of a comment are no names.
[[nodiscard]] ColumnNames find_names(std::string_view text);

// The coordinates brought to the front; all else stays in order. Without one of them the line is
// empty, but one that holds no point anyway, a count for one, stays as it is.
[[nodiscard]] PointLine arranged(const PointLine& line, const ColumnNames& names);

// Whether the first line that is no comment has three numbers at least, or has one, a count, and
// the next has three.
[[nodiscard]] bool begins_with_points(std::string_view bytes);

// These tell such a file from an OFF without its first line.
inline constexpr std::array<std::string_view, 9> kPointExtensions = {
    ".xyz", ".xyzn", ".xyzrgb", ".pts", ".pwn", ".txt", ".asc", ".csv", ".pnt"};

[[nodiscard]] bool has_point_extension(const std::string& name);

// Lines that hold no point are left out and counted. Throws InputError when these are more than
// the points: the file is something else.
[[nodiscard]] PointReadResult read_xyz_points(const MeshSource& source,
                                              const PointReadOptions& options);

}  // namespace meshrepair
