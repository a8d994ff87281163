// SPDX-License-Identifier: MIT
// More triangles, for values that are known at corners alone.
#pragma once

#include <cstddef>

#include <mesh/soup.h>

namespace meshrepair {

// Halves edges that are longer than `length`, the longest first, as long as there are no more than
// `most` triangles. The surface stays as it is but for rounding, and triangles that shared an edge
// share its halves. Points that were there keep their numbers. Pre: all points are finite. Where
// lengths are beyond the range of doubles, nothing is halved. The same result each time.
[[nodiscard]] TriangleSoup split_edges(TriangleSoup soup, double length, std::size_t most);

}  // namespace meshrepair
