// SPDX-License-Identifier: MIT
// Where what triangles carry breaks off.
#pragma once

#include <cstddef>

#include <mesh/attributes.h>
#include <mesh/soup.h>

namespace meshrepair {

// Edges of two triangles that have different values at an end of it, bit for bit. Linear.
[[nodiscard]] std::size_t count_seams(const TriangleSoup& soup, const CornerAttribute& attribute);

}  // namespace meshrepair
