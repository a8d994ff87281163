// SPDX-License-Identifier: MIT
// The working grid: integers of 26 bits over the bounding box of the input.
//
// The unit is a power of two and the origin a multiple of it where doubles allow, so that
// coordinates which are multiples of the unit (float32 data, round numbers) are represented without
// any error, and scaling the input by two or moving it by multiples of the unit gives the same grid
// coordinates.
#pragma once

#include <array>
#include <cstdint>

#include <base/vec3.h>

namespace meshrepair {

struct GridPoint {
  std::int32_t x = 0, y = 0, z = 0;
  constexpr auto operator<=>(const GridPoint&) const = default;  // NOLINT(modernize-use-nullptr)
};

// An axis-parallel box with integer corners, inclusive.
struct GridBox {
  GridPoint low, high;
};

[[nodiscard]] inline Vec3d as_vector(const GridPoint& p) {
  return {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
}

// Grid coordinates lie in [-kGridRadius, kGridRadius].
inline constexpr int kGridBits = 26;
inline constexpr std::int32_t kGridRadius = std::int32_t{1} << (kGridBits - 1);

struct Grid {
  Vec3d origin = Vec3d::Zero();  // the place of grid point (0, 0, 0), in the input's units
  double unit = 1;               // a power of two; the input's length of one grid step

  // Rounds to the nearest grid point. `position` is finite and inside the box the grid was made
  // for.
  [[nodiscard]] GridPoint to_grid(const Vec3d& position) const;
  // The place of a point with (not necessarily integer) grid coordinates.
  [[nodiscard]] Vec3d from_grid(const std::array<double, 3>& coordinates) const {
    return {origin.x() + unit * coordinates[0], origin.y() + unit * coordinates[1],
            origin.z() + unit * coordinates[2]};
  }
};

// The grid for a box that is finite and not empty (it may be flat or a single point).
[[nodiscard]] Grid make_grid(const Vec3d& lowest, const Vec3d& highest);

}  // namespace meshrepair
