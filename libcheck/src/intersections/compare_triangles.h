// SPDX-License-Identifier: MIT
// Comparisons of the triangles of a soup: all with all, or some with all.
//
// The triangles' boxes are put into a tree, and the tree is compared with itself. With a list of
// triangles, pairs without one of these are left out. So are pairs in one height field, and where
// boxes along the axes tell little, oriented ones are asked, too.
#pragma once

#include <cstdint>
#include <span>

#include <check/internal/triangle_list.h>
#include <check/self_intersections.h>

namespace meshrepair::internal {

// All triangles. Both count those that were left out, too.
[[nodiscard]] SelfIntersections compare_all(const SoupCorners& corners,
                                            const SelfIntersectionOptions& options);

// Those on the list with all of the soup.
[[nodiscard]] SelfIntersections compare_with(const SoupCorners& corners, const TriangleList& list,
                                             const SelfIntersectionOptions& options);

// Sheets that cross along an edge: those in which one of `among` is, unless that is empty. Pairs
// that meet elsewhere, too, are there already.
void add_crossing_sheets(const SoupCorners& corners, std::span<const std::uint32_t> among,
                         const SelfIntersectionOptions& options, SelfIntersections& result);

}  // namespace meshrepair::internal
