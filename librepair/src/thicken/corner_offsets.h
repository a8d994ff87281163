// SPDX-License-Identifier: MIT
// Where the corners of a sheet's triangles go when the sheet becomes a wall.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sheet_mesh.h"

namespace meshrepair::internal {

// How far a wall goes from its sheet, against the normals and along them; from 0 on.
struct WallReach {
  double below = 0, above = 0;
};

// The two sides of a sheet: where its normals come from, and where they go.
enum class SheetSide { below, above };
inline constexpr std::array kSheetSides = {SheetSide::below, SheetSide::above};

struct CornerOffsets {
  // Of each corner the number of its vector. Corners of one point that are moved alike have the
  // same number.
  std::vector<std::uint32_t> of_corner;
  // Where a plane of distance 1 would be, so about 1 long.
  std::vector<Vec3d> vectors;
  // How far the walls that triangles share go along each vector: as far as asked for, or as far as
  // none of them is turned over.
  std::array<std::vector<double>, 2> reach;
  // Of each triangle, whether its corners on either side are those of such a wall: not where the
  // triangle is too narrow for its own numbers.
  std::vector<char> has_wall;
  // Of each triangle, whether the shared wall does not go all the way somewhere, so that it has one
  // of its own, too, which stands upright on it.
  std::array<std::vector<char>, 2> has_own;

  [[nodiscard]] double reach_at(std::uint32_t corner, SheetSide side) const {
    return reach[static_cast<std::size_t>(side)][of_corner[corner]];
  }
  [[nodiscard]] bool has_own_wall(std::uint32_t triangle, SheetSide side) const {
    return has_own[static_cast<std::size_t>(side)][triangle] != 0;
  }
  // Whether the shared walls of both triangles at the side end there in the same four points.
  [[nodiscard]] bool goes_on(const SheetMesh& mesh, std::uint32_t side) const;
};

// The corners at a point that lie between the same sharp folds, rims and other joints go the same
// way, where that brings all their triangles nearly to the distance that is asked for. Any other
// goes along its triangle's normal. Where narrow triangles would be turned over, ways that are near
// each other are made more alike, within the same bounds.
[[nodiscard]] CornerOffsets find_corner_offsets(const SheetMesh& mesh, const WallReach& reach);

}  // namespace meshrepair::internal
