// SPDX-License-Identifier: MIT
// What can be asked of hollow().
#pragma once

#include <string>
#include <vector>

#include <base/vec3.h>

namespace meshrepair {

// How much thinner or thicker walls may be, as a share of their thickness.
inline constexpr double kHollowError = 0.02;

struct HollowOptions {
  double wall = 0;                       // T, above 0; 0: nothing is hollowed
  double drain = 0;                      // diameter of the holes; 0: none
  std::vector<Vec3d> drains_at;          // a hole from the place of the surface nearest to each
  std::vector<std::string> drain_names;  // of these points in messages; without: by number
  Vec3d up = Vec3d::UnitZ();             // cavities drain at their lowest places

  [[nodiscard]] bool wanted() const { return wall > 0; }
};

}  // namespace meshrepair
