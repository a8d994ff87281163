// SPDX-License-Identifier: MIT
// Points in grid coordinates: exactly known, with an approximation for speed.
#pragma once

#include <array>
#include <cstdint>

#include <base/ids.h>
#include <exact/grid.h>
#include <exact/plane_table.h>

namespace meshrepair {

// A lattice point (integer coordinates, stored exactly, error 0), or the one common point of three
// planes, or a loose point: just coordinates, which is what an engine without exact arithmetic has.
// A loose point lies on every plane that is within its tolerance.
struct Point {
  std::array<double, 3> position{};  // grid units
  // Bound on the error of each coordinate of `position`; of a loose point its tolerance, not 0.
  float error = 0;
  std::array<PlaneId, 3>
      planes{};  // all valid: their common point. Else lattice (error 0) or loose

  [[nodiscard]] bool is_lattice() const { return !planes[0].valid() && error == 0; }
  [[nodiscard]] bool is_loose() const { return !planes[0].valid() && error != 0; }
  // Only for lattice points.
  [[nodiscard]] GridPoint lattice() const {
    return {static_cast<std::int32_t>(position[0]), static_cast<std::int32_t>(position[1]),
            static_cast<std::int32_t>(position[2])};
  }
};

[[nodiscard]] Point lattice_point(const GridPoint& at);
[[nodiscard]] Point loose_point(const std::array<double, 3>& at, double tolerance = 0);

// The common point of three planes; a lattice point whenever its coordinates are integers, whatever
// the planes. The order of the planes does not matter. When the planes have no single common point,
// or one outside what the grid covers, returns a loose point at `fallback` instead.
[[nodiscard]] Point meet(const PlaneTable& planes, PlaneId a, PlaneId b, PlaneId c,
                         const std::array<double, 3>& fallback);

// The point's coordinates as near to the truth as doubles allow: to about 2^-25 of a grid step.
[[nodiscard]] std::array<double, 3> accurate_position(const Point& point, const PlaneTable& planes);

}  // namespace meshrepair
