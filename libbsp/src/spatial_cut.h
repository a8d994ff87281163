// SPDX-License-Identifier: MIT
// Axis-parallel cuts of many fragments by a binned surface-area heuristic.
#pragma once

#include <optional>
#include <span>

#include <bsp/build_tree.h>
#include <exact/plane.h>

#include "fragment_pool.h"

namespace meshrepair::internal {

struct SpatialCut {
  Plane plane;
  double cut_share = 0;  // of the fragments, by their bounding boxes
};

// The best cut at a half-integer coordinate, so that no grid point lies on it; nothing when no cut
// separates the fragments well enough for the options.
[[nodiscard]] std::optional<SpatialCut> find_spatial_cut(const FragmentPool& pool,
                                                         std::span<const FragmentId> fragments,
                                                         const BuildTreeOptions& options);

}  // namespace meshrepair::internal
