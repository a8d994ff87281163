// SPDX-License-Identifier: MIT
// What a length of 1 is in a file.
#pragma once

#include <optional>
#include <string_view>

#include <mesh/soup.h>

namespace meshrepair {

enum class LengthUnit { micron, millimeter, centimeter, inch, foot, meter };

[[nodiscard]] double millimeters(LengthUnit unit);

// What lengths in one unit are multiplied with to be in another.
[[nodiscard]] double unit_scale(LengthUnit from, LengthUnit to);
// Points of the one unit get coordinates in the other; of the same they stay as they are.
void bring_to_unit(LengthUnit from, LengthUnit to, TriangleSoup& soup);

// "millimeter", as 3MF names it; nothing where it is no such name.
[[nodiscard]] std::string_view unit_name(LengthUnit unit);
[[nodiscard]] std::optional<LengthUnit> unit_named(std::string_view name);

}  // namespace meshrepair
