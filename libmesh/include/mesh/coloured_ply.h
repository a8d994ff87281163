// SPDX-License-Identifier: MIT
// A mesh with a colour on each triangle, to be looked at.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <mesh/soup.h>

namespace meshrepair {

using Colour = std::array<std::uint8_t, 3>;  // red, green, blue

// The bytes of a binary PLY file whose faces have the properties red, green and blue. One colour
// for each triangle; no newlines inside the comments.
[[nodiscard]] std::string format_coloured_ply(const TriangleSoup& soup,
                                              std::span<const Colour> colours,
                                              const std::vector<std::string>& comments = {});

}  // namespace meshrepair
