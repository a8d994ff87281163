// SPDX-License-Identifier: MIT
// Walls around the edges of sheets at which the walls of triangles do not go on in each other.
#pragma once

#include <cstdint>
#include <vector>

#include <repair/thicken_sheets.h>

#include "corner_offsets.h"
#include "sheet_mesh.h"

namespace meshrepair::internal {

// A piece of an edge's wall at one end of it: points around that end. One with the other of the
// same edge, they are the corners of a wall around it.
struct FoldEnd {
  std::uint32_t corner = 0;  // one of those that are there
  std::vector<Vec3d> points;
  Vec3d inner;  // on the edge, in the wall
};

// Adds to the walls what is between those of triangles at folds, seams, and edges of many
// triangles. Returns the ends of all these, for the corners where several meet.
[[nodiscard]] std::vector<FoldEnd> append_folds(const SheetMesh& mesh, const CornerOffsets& offsets,
                                                const WallReach& reach, SheetWalls& walls,
                                                ThickenReport& report);

}  // namespace meshrepair::internal
