// Where the corners of a sheet's triangles go when the sheet becomes a wall.
#pragma once

#include <cstdint>
#include <vector>

#include "sheet_mesh.h"

namespace meshrepair::internal {

// How far a wall goes from its sheet, against the normals and along them; from 0 on.
struct WallReach {
  double below = 0, above = 0;
};

struct CornerOffsets {
  // Of each corner the number of its vector. Corners of one point that are moved alike have the
  // same number.
  std::vector<std::uint32_t> of_corner;
  // Where a plane of distance 1 would be, so about 1 long.
  std::vector<Vec3d> vectors;
  // Of each triangle whether its corners, moved to either side, are those of a wall: not where it
  // is too narrow for its own numbers.
  std::vector<char> has_wall;

  // Whether the walls of both triangles at the side end there in the same four points.
  [[nodiscard]] bool goes_on(const SheetMesh& mesh, std::uint32_t side) const;
};

// The corners at a point that lie between the same sharp folds, rims and other joints go the same
// way, where that brings all their triangles nearly to the distance that is asked for, and turns
// none of them over. Any other goes along its triangle's normal.
[[nodiscard]] CornerOffsets find_corner_offsets(const SheetMesh& mesh, const WallReach& reach);

}  // namespace meshrepair::internal
