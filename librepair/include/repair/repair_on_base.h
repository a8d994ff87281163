// SPDX-License-Identifier: MIT
// From an open surface, such as a terrain's triangles (TIN), to a solid that stands on a floor.
//
//   ScanBaseOptions base;
//   base.floor = 0;
//   ScanBaseReport stands;
//   RepairReport report;
//   const Surface solid = repair_on_base(terrain, base, {}, stands, report);
#pragma once

#include <points/scan_base.h>
#include <repair/repair.h>

namespace meshrepair {

// How what is open on a base is closed: of any size, each loop by itself. A hole and the floor face
// each other, and are no gap between two pieces.
[[nodiscard]] HoleOptions holes_over_floor(HoleOptions holes);

// The soup with walls and a floor (with_base()), repaired, its holes closed however large they are.
// All its triangles stay in it; those of walls and floor have no source. Corners in one place are
// one, and so are copies of a triangle. Throws as with_base() and repair() do.
[[nodiscard]] Surface repair_on_base(const TriangleSoup& soup, const ScanBaseOptions& base,
                                     const RepairOptions& options, ScanBaseReport& stands,
                                     RepairReport& report);

}  // namespace meshrepair
