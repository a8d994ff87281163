// SPDX-License-Identifier: MIT
// Walls of triangles whose shared walls do not go all the way.
#pragma once

#include <cstdint>

#include <repair/thicken_sheets.h>

#include "corner_offsets.h"
#include "sheet_mesh.h"

namespace meshrepair::internal {

// Adds walls that stand upright on the sheet, from it to either side, for triangles that have such
// a one. Those that lie in one plane, but for rounding, share it.
void append_own_walls(const SheetMesh& mesh, const CornerOffsets& offsets, const WallReach& reach,
                      SheetWalls& walls);

// Whether the two triangles at the side share such a wall.
[[nodiscard]] bool share_own_wall(const SheetMesh& mesh, const CornerOffsets& offsets,
                                  std::uint32_t side, SheetSide of);

}  // namespace meshrepair::internal
