// SPDX-License-Identifier: MIT
// Bodies whose faces nearly coincide leave slivers between them that are thinner than numbers can
// say. A point moves onto one nearby, whether an edge joins the two or not; an edge is led over a
// point, or two over a new one; or an edge is turned. As a map of chains that keeps the boundary of
// each region closed: a triangle with two equal corners is nothing, and equal triangles add up. So
// a chamber that is flat is no more, and what is on both its sides is next to each other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <base/progress.h>
#include <mesh/precision.h>

#include "region_complex.h"

namespace meshrepair::internal {

struct MergeOptions {
  double within = 0;                         // how far a point or an edge may move
  Precision precision = Precision::float64;  // of new points
  ProgressObserver* progress = nullptr;      // not owned
};

// Two triangles that meet; or twice one that has no area, or is at an edge that is turned
// (region_edges.h).
using FaultyPairs = std::vector<std::array<std::uint32_t, 2>>;

// For each pair the edit around it that leaves the fewest faults, as long as one leaves fewer.
// Returns how many were made, and the most that a point or an edge moved.
[[nodiscard]] std::size_t merge_points(RegionComplex& complex, const FaultyPairs& pairs,
                                       const MergeOptions& options, double& distance);

}  // namespace meshrepair::internal
