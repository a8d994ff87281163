// SPDX-License-Identifier: MIT
// Pictures as control sequences, which some terminals draw between lines of text.
#pragma once

#include <string>

#include <picture/pixels.h>

namespace meshrepair {

// As DEC's terminals had them, with at most 256 colours: of more, the most frequent shades are
// kept, and the others become the nearest of these. Opacity is not looked at. Pre: there is a
// pixel.
[[nodiscard]] std::string format_sixel(const Pixels& pixels);

// As the protocol of the terminal kitty has them: a PNG in pieces. Pre: there is a pixel.
[[nodiscard]] std::string format_kitty(const Pixels& pixels);

}  // namespace meshrepair
