// The nearest neighbours of every point of a cloud, in one flat array.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <base/progress.h>
#include <mesh/soup.h>

#include "point_index.h"

namespace meshrepair {

struct Neighbourhoods {
  std::size_t per_point = 0;  // the same for all
  std::vector<std::uint32_t> points;

  // Nearest first, without the point itself.
  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t point) const {
    return {points.data() + point * per_point, per_point};
  }
};

// At most this many, or as many others as there are; `index` is that of the points. Parallel.
// Throws Cancelled.
[[nodiscard]] Neighbourhoods find_neighbourhoods(const PointIndex& index,
                                                 const std::vector<Vec3d>& points,
                                                 std::size_t count, ProgressObserver* progress);

}  // namespace meshrepair
