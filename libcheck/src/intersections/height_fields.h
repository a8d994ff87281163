// SPDX-License-Identifier: MIT
// Regions of a mesh whose triangles need not be compared with each other, however long they are.
#pragma once

#include <cstdint>
#include <vector>

#include <check/box_tree.h>
#include <check/internal/triangle_list.h>

namespace meshrepair::internal {

// Are most triangles in large regions, told by a sample? Else looking for them takes longer than it
// spares.
[[nodiscard]] bool may_have_height_fields(const TriangleList& triangles, const BoxTree& tree);

// Of each triangle the region that it belongs to, named by one of its triangles, or kNone. No two
// triangles of a region have more in common than corners and edges that they share. `tree` is that
// of their boxes. Exact; the same on any number of threads. Linear where regions are compact, and
// n log n where they meet themselves everywhere.
[[nodiscard]] std::vector<std::uint32_t> find_height_fields(const TriangleList& triangles,
                                                            const BoxTree& tree);

}  // namespace meshrepair::internal
