// SPDX-License-Identifier: MIT
// Colours as screens and pictures have them, and as light adds up.
#pragma once

namespace meshrepair {

// The transfer function of IEC 61966-2-1, which names the colour space sRGB, and its inverse. Both
// are of one part of a colour; 0 and 1 stay as they are, and so does what is not between them.
[[nodiscard]] double linear_of_srgb(double value);
[[nodiscard]] double srgb_of_linear(double value);

}  // namespace meshrepair
