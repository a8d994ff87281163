// SPDX-License-Identifier: MIT
// Finding the place of a complex vertex in the input's own coordinates.
#pragma once

#include <optional>

#include <base/internal/hash_index.h>
#include <bsp/clean_soup.h>
#include <exact/point.h>

namespace meshrepair::internal {

class InputPoints {
 public:
  explicit InputPoints(const CleanSoup& soup);

  // The input point at this place; invalid when there is none.
  [[nodiscard]] PointId find(const Point& point) const;

  // The grid point that a point is; of a loose one the nearest, half a step away at most along each
  // axis, which is no more than points of the input were moved to lie on the grid.
  [[nodiscard]] static std::optional<GridPoint> lattice_of(const Point& point);

 private:
  const CleanSoup& soup_;
  HashIndex index_;
};

}  // namespace meshrepair::internal
