// Points of a terrain that a file of single precision puts above each other.
#pragma once

#include <optional>

#include <mesh/point_cloud.h>

namespace meshrepair::internal {

// The cloud as it can be written in single precision, if that brings points that are beside each
// other into one column along `axis`; of these it has the first alone. Nothing if it brings none.
[[nodiscard]] std::optional<PointCloud> without_joined_columns(const PointCloud& cloud, int axis);

}  // namespace meshrepair::internal
