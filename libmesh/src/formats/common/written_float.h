// SPDX-License-Identifier: MIT
// Coordinates as formats of single precision have them.
#pragma once

#include <string_view>

namespace meshrepair {

// Throws OutputError, with the name of the format, where single precision has no such number.
[[nodiscard]] float written_float(double coordinate, std::string_view format);

}  // namespace meshrepair
