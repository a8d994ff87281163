// SPDX-License-Identifier: MIT
// What is left of a cloud once points that say nothing are dropped, and the nearest neighbours of
// every point of it, in one flat array.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <base/progress.h>
#include <mesh/point_cloud.h>
#include <mesh/soup.h>
#include <points/point_soup.h>

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

// A cloud to compute with: moved and scaled into the unit box, so that no length overflows.
struct SiftedCloud {
  std::vector<Vec3d> points;
  std::vector<Vec3d> normals;           // of length 1, or 0 where none is known; may be empty
  std::vector<std::uint32_t> original;  // the number that each has in the cloud, ascending
  Vec3d centre = Vec3d::Zero();
  double scale = 1;                         // a length of 1 here, in the units of the cloud
  std::vector<double> spacing;              // of each point
  std::unique_ptr<const PointIndex> index;  // of the points, from look_around()
  Neighbourhoods around;
};

// Drops what is not finite, there twice, or an outlier, as the options say. Throws Cancelled.
[[nodiscard]] SiftedCloud sift_points(const PointCloud& cloud, const PointSoupOptions& options,
                                      PointSoupReport& report);

// Makes the index and finds the neighbours and the spacing of points that were moved. Throws
// Cancelled.
void look_around(SiftedCloud& cloud, const PointSoupOptions& options);

}  // namespace meshrepair
