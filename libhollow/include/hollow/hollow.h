// SPDX-License-Identifier: MIT
// hollow() makes cavities in a solid, so that walls of a given thickness are left of it.
//
// A cavity is a connected part of { x inside the solid : the distance of x from the surface is
// above T }. The distance is that to any part of the surface, so voids that are there already get
// walls, too. Where HollowReport::unproven is 0,
//
//  1. no point of a wall's inner side is nearer to the surface than T (1 - kHollowError), and none
//     is farther from it than T (1 + kHollowError): HollowReport::least and most bound them, on
//     the coordinates that come back, drains excepted;
//  2. all that is deeper than T (1 + kHollowError) is in a cavity, or counted as left full.
//
// The surface of the solid stays bit for bit, but for the mouths of drains.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <extract/surface.h>
#include <repair/repair.h>

namespace meshrepair {

inline constexpr double kHollowError = 0.02;

struct HollowOptions {
  double wall = 0;               // T, above 0; 0: nothing is hollowed
  double drain = 0;              // diameter of the holes; 0: none
  std::vector<Vec3d> drains_at;  // a hole from the place of the surface nearest to each
  Vec3d up = Vec3d::UnitZ();     // cavities drain at their lowest places

  [[nodiscard]] bool wanted() const { return wall > 0; }
};

// A cylinder through a wall.
struct Drain {
  Vec3d at = Vec3d::Zero();         // its middle on the surface
  Vec3d direction = Vec3d::Zero();  // into the cavity; of length 1
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
  // Cavities that would hold no ball of the diameter of drains, or, without drains, of a quarter
  // of the wall: not made.
  std::size_t left_full = 0;
  double left_full_volume = 0;
  double volume_before = 0;  // of the solid
  double least = 0;          // proven: no point of an inner side is nearer to the surface
  double most = 0;           // nor farther from it; 0 and 0 without cavities
  std::size_t unproven = 0;  // pieces of space for which no proof was found
  std::size_t cells = 0;     // tetrahedra that space was divided into
  double finest = 0;         // the longest edge of the smallest one that a wall passes
};

// Of a surface that repair() returned. `options` say how the result is certified, and `report` of
// it is replaced: certificate, topology and sizes. Sources of the result are triangles of `solid`;
// walls have none. The solid itself where there is no cavity. Throws UsageError for options out of
// range, ValueError where no drain fits, LimitError where the wall is too thin beside the solid,
// Cancelled.
[[nodiscard]] Surface hollow(const Surface& solid, const HollowOptions& hollow,
                             const RepairOptions& options, HollowReport& hollowed,
                             RepairReport& report);

}  // namespace meshrepair
