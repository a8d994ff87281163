// SPDX-License-Identifier: MIT
// Sheets that pass through one another along an edge that both have.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <check/internal/triangle_list.h>

namespace meshrepair::internal {

// A sheet has two triangles at an edge of two indices. Where other points are in the same places,
// other sheets may have an edge there; no two triangles of two sheets then need to meet elsewhere,
// though the sheets cross. Pairs of triangles, the lower one first, one pair for each two sheets
// that cross at an edge; ascending. `corners` is welded. Exact.
[[nodiscard]] std::vector<std::array<std::uint32_t, 2>> find_crossing_sheets(
    const SoupCorners& corners);

}  // namespace meshrepair::internal
