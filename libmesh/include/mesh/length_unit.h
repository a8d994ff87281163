// What a length of 1 is in a file.
#pragma once

#include <optional>
#include <string_view>

namespace meshrepair {

enum class LengthUnit { micron, millimeter, centimeter, inch, foot, meter };

[[nodiscard]] double millimeters(LengthUnit unit);

// "millimeter", as 3MF names it; nothing where it is no such name.
[[nodiscard]] std::string_view unit_name(LengthUnit unit);
[[nodiscard]] std::optional<LengthUnit> unit_named(std::string_view name);

}  // namespace meshrepair
