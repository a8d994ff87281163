// SPDX-License-Identifier: MIT
// Regions of a mesh whose triangles need not be compared with each other, however long they are.
#pragma once

#include <cstdint>
#include <vector>

#include <check/internal/triangle_list.h>

namespace meshrepair::internal {

// Of each triangle the region that it belongs to, named by its lowest triangle, or kNone. No two
// triangles of a region have more in common than corners and edges that they share. Exact; the same
// on any number of threads. n log n, and linear where regions are compact.
[[nodiscard]] std::vector<std::uint32_t> find_height_fields(const TriangleList& triangles);

}  // namespace meshrepair::internal
