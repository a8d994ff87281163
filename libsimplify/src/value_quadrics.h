// SPDX-License-Identifier: MIT
// How far values at corners of triangles, such as colours, would be from what they are.
//
// Over a triangle each value is a linear function of the place. Where a point stands for several
// triangles, it costs what the best value that it can have is off theirs, squared and times their
// area (H. Hoppe: New quadric metric for simplifying meshes with appearance attributes, 1999). With
// the best value put in, that is a quadric of the place alone:
//
//   sum w (g x + d)^2 - (sum w (g x + d))^2 / sum w
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <base/vec3.h>

#include "quadric.h"

namespace meshrepair::internal {

class ValueQuadrics {
 public:
  // Of so many points; each corner has so many values.
  ValueQuadrics(std::size_t points, std::size_t components);

  // To a corner of a triangle; `values` are those of its three corners, one after the other.
  void add_triangle(std::uint32_t point, const std::array<Vec3d, 3>& corners,
                    std::span<const double> values, double weight);

  // The quadric of both points together is added to `to`.
  void add_to(Quadric& to, std::uint32_t a, std::uint32_t b) const;

  // One point stands for what another one stood for, too.
  void join(std::uint32_t point, std::uint32_t other);

 private:
  std::size_t components_;
  std::vector<Quadric> squares_;  // sum w (g x + d)^2 of all values
  // Of each point and value sum w g and sum w d.
  std::vector<std::array<double, 4>> sums_;
};

}  // namespace meshrepair::internal
