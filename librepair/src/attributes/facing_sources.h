// SPDX-License-Identifier: MIT
// Which of several triangles in one place a triangle of the result has its attributes from.
#pragma once

#include <cstdint>
#include <vector>

#include <extract/surface.h>
#include <mesh/soup.h>

namespace meshrepair::internal {

// Surface::source, but where that triangle faces the other way than the result's: the first one
// that has the same corners and faces as the result's, if there is such a one. n log n of those
// that are turned, linear of all others.
[[nodiscard]] std::vector<std::uint32_t> facing_sources(const TriangleSoup& input,
                                                        const Surface& surface);

}  // namespace meshrepair::internal
