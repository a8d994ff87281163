// SPDX-License-Identifier: MIT
// What kind of file an option or argument names, for whoever completes command lines.
#pragma once

#include <string>
#include <string_view>

#include "options/command_line.h"

namespace meshrepair {

// For check(): takes every word, as content decides, not names. `extensions` is ".stl, .obj".
[[nodiscard]] Check names_file(std::string_view extensions);
// Of a file beside the output, which an option asks for: an empty name would be as if it was not
// given.
[[nodiscard]] Check names_side_file(std::string_view extensions);

// Those of meshes, also packed; the same and those of points; and those of trees beside meshes.
[[nodiscard]] std::string mesh_extensions();
[[nodiscard]] std::string mesh_and_point_extensions();
[[nodiscard]] std::string mesh_and_tree_extensions();
[[nodiscard]] std::string point_extensions();

inline constexpr std::string_view kTreeExtension = ".bsp";
inline constexpr std::string_view kPackedExtensions = ".gz, .zst, .zip";

}  // namespace meshrepair
