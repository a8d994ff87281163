// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <exact/grid.h>

namespace meshrepair {
namespace {

// The centre of [low, high], rounded to a multiple of the unit. Halving first keeps it finite. Ties
// go up, not to the even multiple, so that a box moved by an odd number of steps gets an origin
// moved by as many.
double rounded_centre(double low, double high, double unit) {
  const double centre = 0.5 * low + 0.5 * high;
  const double steps = centre / unit;
  if (!std::isfinite(steps)) return centre;
  const double whole = std::floor(steps);
  return (steps - whole >= 0.5 ? whole + 1 : whole) * unit;
}

std::int32_t nearest_step(double distance, double unit) {
  const double steps = std::nearbyint(distance / unit);
  return static_cast<std::int32_t>(
      std::clamp(steps, -static_cast<double>(kGridRadius), static_cast<double>(kGridRadius)));
}

}  // namespace

GridPoint Grid::to_grid(const Vec3d& position) const {
  return {nearest_step(position.x() - origin.x(), unit),
          nearest_step(position.y() - origin.y(), unit),
          nearest_step(position.z() - origin.z(), unit)};
}

Grid make_grid(const Vec3d& lowest, const Vec3d& highest) {
  // Half the extent, so that boxes as large as the doubles themselves do not overflow.
  double half_extent = 0;
  double largest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    half_extent = std::max(half_extent, 0.5 * highest[axis] - 0.5 * lowest[axis]);
    largest = std::max({largest, std::abs(lowest[axis]), std::abs(highest[axis])});
  }
  int exponent = 0;
  // A single point has no extent; its own size gives a unit that doubles can tell apart from it.
  // Half of the smallest extent that doubles know is rounded to 0, and gives the smallest unit.
  const double without_extent = lowest == highest ? std::max(largest, 0x1p-1000) : 0x1p-1074;
  const double size = half_extent > 0 ? half_extent : without_extent;
  std::frexp(size, &exponent);  // size < 2^exponent
  // One bit of room: rounding the origin to a multiple of the unit moves it by up to half a unit.
  Grid grid;
  const bool tight = std::ldexp(1.0, exponent) - size <= std::ldexp(1.0, exponent - kGridBits);
  grid.unit = std::ldexp(1.0, std::max(exponent - (kGridBits - 1) + (tight ? 1 : 0), -1074));
  for (int axis = 0; axis < 3; ++axis) {
    grid.origin[axis] = rounded_centre(lowest[axis], highest[axis], grid.unit);
  }
  return grid;
}

}  // namespace meshrepair
