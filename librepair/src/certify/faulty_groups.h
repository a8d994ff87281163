// SPDX-License-Identifier: MIT
// Which groups of parts of a surface have faults.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <check/part_groups.h>
#include <check/self_intersections.h>
#include <extract/surface.h>
#include <mesh/soup.h>

namespace meshrepair::internal {

// Those of the pairs that were found, those without area if some were, and, where the format joins
// points, those with a corner whose coordinates another point has, too. May repeat.
[[nodiscard]] std::vector<std::uint32_t> triangles_at_fault(const TriangleSoup& mesh,
                                                            const SelfIntersections& found,
                                                            bool joins_points);

// Parts whose boxes do not meet have nothing to do with each other: what crosses, or lies in,
// something else is in one group with it. Nor, mostly, do they once points have moved a little.
[[nodiscard]] PartGroups groups_apart(const TriangleSoup& mesh);

// Takes those of its groups out of the surface that have one of these triangles, in their order.
[[nodiscard]] std::vector<Surface> take_groups(Surface& surface, const PartGroups& groups,
                                               std::span<const std::uint32_t> at_fault);

}  // namespace meshrepair::internal
