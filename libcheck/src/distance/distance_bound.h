// SPDX-License-Identifier: MIT
// An upper bound on the distance of any point of one mesh from another.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <base/progress.h>
#include <check/internal/nearest_triangle.h>

namespace meshrepair::internal {

struct BoundOptions {
  double factor = 1.1;
  std::size_t most_pieces = 0;
  double known = 0;      // a distance that some point is known to have
  double magnitude = 0;  // no coordinate of either mesh is larger
  ProgressObserver* progress = nullptr;
};

// Not below the distance of any point of `from`. At most `factor` times the largest distance of any
// point looked at and what rounding adds, unless `most_pieces` came first.
[[nodiscard]] double distance_bound(std::span<const Corners> from, const NearestTriangle& to,
                                    const BoundOptions& options);

// Of each triangle of `from` whether some point of it may be farther than `distance`; no coordinate
// is larger than `magnitude`.
[[nodiscard]] std::vector<char> are_beyond(std::span<const Corners> from, const NearestTriangle& to,
                                           double distance, double magnitude,
                                           ProgressObserver* progress);

}  // namespace meshrepair::internal
