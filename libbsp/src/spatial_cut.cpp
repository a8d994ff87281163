// SPDX-License-Identifier: MIT
#include "spatial_cut.h"

#include <algorithm>
#include <array>
#include <limits>

namespace meshrepair::internal {
namespace {

constexpr std::size_t kBins = 32;
// In grid steps. The bounds are rounded to float (an error of at most 2 steps), so a cut a bin's
// width away from both ends has corners strictly on both sides, and cuts the region properly.
constexpr float kThinnestBin = 16;

struct Bounds {
  std::array<float, 3> low, high;
};

Bounds bounds_of(const FragmentPool& pool, std::span<const FragmentId> fragments) {
  Bounds box{pool[fragments[0]].low, pool[fragments[0]].high};
  for (const FragmentId id : fragments) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(box.low[axis], pool[id].low[axis]);
      box.high[axis] = std::max(box.high[axis], pool[id].high[axis]);
    }
  }
  return box;
}

struct Bins {
  std::array<std::size_t, kBins> begin{}, end{};  // fragments that begin or end in each bin
};

Bins count_bins(const FragmentPool& pool, std::span<const FragmentId> fragments, std::size_t axis,
                float low, float width) {
  const auto bin_of = [&](float x) {
    return std::min(static_cast<std::size_t>(std::max((x - low) / width, 0.0f)), kBins - 1);
  };
  Bins bins;
  for (const FragmentId id : fragments) {
    ++bins.begin[bin_of(pool[id].low[axis])];
    ++bins.end[bin_of(pool[id].high[axis])];
  }
  return bins;
}

// Half the surface of the box from `low` to `high`.
double half_area(const std::array<double, 3>& size) {
  return size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
}

struct Best {
  double cost = std::numeric_limits<double>::infinity();
  std::size_t axis = 0;
  double at = 0;
  std::size_t both = 0;  // fragments on both sides
};

void try_axis(const Bins& bins, const Bounds& box, std::size_t axis, std::size_t count,
              const BuildTreeOptions& options, Best& best) {
  const double width = (static_cast<double>(box.high[axis]) - box.low[axis]) / kBins;
  std::array<double, 3> size{};
  for (std::size_t a = 0; a < 3; ++a) size[a] = static_cast<double>(box.high[a]) - box.low[a];
  std::size_t left = 0;
  std::size_t ended = 0;
  for (std::size_t cut = 1; cut < kBins; ++cut) {
    left += bins.begin[cut - 1];
    ended += bins.end[cut - 1];
    const std::size_t right = count - ended;
    const double limit = static_cast<double>(count);
    if (static_cast<double>(left + right) > options.largest_total_share * limit) continue;
    if (static_cast<double>(std::max(left, right)) > options.largest_side_share * limit) continue;
    std::array<double, 3> left_size = size;
    std::array<double, 3> right_size = size;
    left_size[axis] = width * static_cast<double>(cut);
    right_size[axis] = size[axis] - left_size[axis];
    const double cost = half_area(left_size) * static_cast<double>(left) +
                        half_area(right_size) * static_cast<double>(right);
    if (cost < best.cost) {
      best = {cost, axis, box.low[axis] + left_size[axis], left + right - count};
    }
  }
}

}  // namespace

std::optional<SpatialCut> find_spatial_cut(const FragmentPool& pool,
                                           std::span<const FragmentId> fragments,
                                           const BuildTreeOptions& options) {
  const Bounds box = bounds_of(pool, fragments);
  Best best;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float width = (box.high[axis] - box.low[axis]) / static_cast<float>(kBins);
    if (!(width > kThinnestBin)) continue;
    const Bins bins = count_bins(pool, fragments, axis, box.low[axis], width);
    try_axis(bins, box, axis, fragments.size(), options, best);
  }
  if (best.cost == std::numeric_limits<double>::infinity()) return std::nullopt;
  std::array<std::int64_t, 3> normal{};
  normal[best.axis] = 2;
  const auto below = static_cast<std::int64_t>(std::floor(best.at));
  return SpatialCut{make_plane(normal, -(2 * Int128{below} + 1)),
                    static_cast<double>(best.both) / static_cast<double>(fragments.size())};
}

}  // namespace meshrepair::internal
