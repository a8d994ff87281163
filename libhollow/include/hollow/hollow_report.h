// SPDX-License-Identifier: MIT
// What hollow() made.
#pragma once

#include <cstddef>
#include <vector>

#include <base/vec3.h>

namespace meshrepair {

// A cylinder through a wall.
struct Drain {
  Vec3d at = Vec3d::Zero();         // its middle on the surface
  Vec3d direction = Vec3d::Zero();  // into the cavity; of length 1
  // From below, its least distance from other drains, and from all of the surface but that around
  // its mouth. At most the wall.
  double beside = 0;
};

struct Cavity {
  double volume = 0;    // as made, without drains
  double diameter = 0;  // of the largest ball within, from below
  std::vector<Drain> drains;
  bool opens = false;  // the result has no closed void here
};

struct HollowReport {
  double wall = 0;   // as asked for; 0: nothing was asked for
  double drain = 0;  // diameter
  std::vector<Cavity> cavities;
  // Cavities that would hold no ball of this diameter are not made: that of drains, or a quarter of
  // the wall where that is more.
  double least_diameter = 0;
  std::size_t left_full = 0;
  double left_full_volume = 0;
  double volume_before = 0;  // of the solid
  double least = 0;          // proven: no point of an inner side is nearer to the surface
  double most = 0;           // nor farther from it; 0 and 0 without cavities
  double beside_drains = 0;  // the least of Drain::beside; 0 without drains
  std::size_t unproven = 0;  // pieces of space for which no proof was found
  std::size_t cells = 0;     // tetrahedra that space was divided into
  double finest = 0;         // the longest edge of the smallest one that a wall passes
};

}  // namespace meshrepair
