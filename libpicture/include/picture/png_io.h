// SPDX-License-Identifier: MIT
// Pictures as PNG.
#pragma once

#include <string>
#include <string_view>

#include <picture/pixels.h>

namespace meshrepair {

// The bytes of the file; without opacity where all is opaque. Pixels are kept bit for bit; how they
// are packed depends on the version of zlib alone. Pre: there is a pixel.
[[nodiscard]] std::string format_png(const Pixels& pixels);

}  // namespace meshrepair
