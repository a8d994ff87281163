// Far from the origin the steps of single precision are wider than a terrain's points are apart.
// Rounded after they were triangulated, points beside each other would come to lie above each
// other, and triangles between them would cross all over.
#include "columns.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <mesh/precision.h>

namespace meshrepair::internal {
namespace {

using Column = std::array<double, 2>;

Column column_of(const Vec3d& p, int axis) { return {p[(axis + 1) % 3], p[(axis + 2) % 3]}; }

template <class T>
void keep(const std::vector<std::uint32_t>& kept, std::vector<T>& of_points) {
  if (of_points.empty()) return;
  for (std::size_t i = 0; i < kept.size(); ++i) of_points[i] = of_points[kept[i]];
  of_points.resize(kept.size());
}

}  // namespace

std::optional<PointCloud> without_joined_columns(const PointCloud& cloud, int axis) {
  PointCloud rounded = cloud;
  std::vector<std::uint32_t> finite, kept;
  for (std::uint32_t i = 0; i < cloud.points.size(); ++i) {
    Vec3d& p = rounded.points[i];
    p = rounded_to(p, Precision::float32);
    (p.allFinite() ? finite : kept).push_back(i);
  }
  const auto column = [&](std::uint32_t i) { return column_of(rounded.points[i], axis); };
  std::stable_sort(finite.begin(), finite.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return column(a) < column(b); });
  std::uint32_t first = 0;  // of its column
  for (std::size_t i = 0; i < finite.size(); ++i) {
    if (i == 0 || column(finite[i]) != column(first)) first = finite[i];
    const bool is_beside =
        column_of(cloud.points[finite[i]], axis) != column_of(cloud.points[first], axis);
    if (!is_beside) kept.push_back(finite[i]);
  }
  if (kept.size() == cloud.points.size()) return std::nullopt;
  std::sort(kept.begin(), kept.end());
  keep(kept, rounded.points);
  keep(kept, rounded.normals);
  keep(kept, rounded.colours);
  return rounded;
}

}  // namespace meshrepair::internal
