// SPDX-License-Identifier: MIT
// Bodies so far from each other that a ball rolls around each as if it were alone.
#pragma once

#include <span>

#include <check/box_tree.h>
#include <mesh/mesh_parts.h>
#include <mesh/soup.h>

namespace meshrepair::internal {

// Groups of parts, numbered from 0 by their first triangles. Between the boxes of two groups there
// is more than the gap along some axis: `gap`, or that share of the diagonal of the largest part
// among all that are to be divided. n log n for each time that what is left has to be divided.
[[nodiscard]] MeshParts bodies_apart(const TriangleSoup& mesh, double gap, bool is_share);

// Whether planes across axes part all boxes, one from the other.
[[nodiscard]] bool are_apart(std::span<const Box> boxes);

}  // namespace meshrepair::internal
