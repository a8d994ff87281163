// SPDX-License-Identifier: MIT
// Walls around the points of sheets at which several folds meet.
#pragma once

#include <vector>

#include <repair/thicken_sheets.h>

#include "corner_offsets.h"
#include "fold_walls.h"
#include "sheet_mesh.h"

namespace meshrepair::internal {

// Adds to the walls what those of triangles and `folds` leave open there: a part of a ball, inside
// the round of the folds.
void append_corners(const SheetMesh& mesh, const WallReach& reach,
                    const std::vector<FoldEnd>& folds, SheetWalls& walls, ThickenReport& report);

}  // namespace meshrepair::internal
