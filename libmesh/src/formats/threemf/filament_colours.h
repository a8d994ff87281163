// SPDX-License-Identifier: MIT
// The colours of a slicer's filaments.
#pragma once

#include <array>
#include <string_view>
#include <vector>

namespace meshrepair {

// A part of the package that may say them: Metadata/Slic3r_PE.config has lines of
// "; filament_colour = #FF8000;#DB5182", where extruder_colour comes first if it says one, and
// Metadata/project_settings.config is JSON with a list of that name. By the key of its name.
[[nodiscard]] bool is_print_settings(std::string_view key);

// As sRGB has them, with opacity, in the order of the filaments; white where none is said. None if
// there are none.
[[nodiscard]] std::vector<std::array<double, 4>> read_filament_colours(std::string_view settings);

}  // namespace meshrepair
