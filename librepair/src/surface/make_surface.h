// SPDX-License-Identifier: MIT
// From labelled cells to a surface that is certified.
#pragma once

#include <optional>
#include <vector>

#include <base/stage_meter.h>
#include <bsp/clean_soup.h>
#include <extract/surface.h>
#include <repair/orient_parts.h>
#include <repair/repair_options.h>
#include <repair/repair_report.h>

#include "cells/covered_cells.h"
#include "resume/saved_states.h"

namespace meshrepair::internal {

// Divides space along all triangles of the soup, finds which cells are solid, and makes the surface
// between these and the others. Throws NoSolidError when none is.
[[nodiscard]] Surface surface_by_cells(CleanSoup soup, const Orientation& orientation,
                                       const RepairOptions& options, RepairReport& report,
                                       StageMeter& meter);

// The surface that all cells would give, made without them where surface_of_chambers() can; nothing
// elsewhere, or if it is to be certified and is not, and the report says only which stages there
// were. What came of it before it was finished is kept.
[[nodiscard]] std::optional<Surface> surface_by_chambers(const CleanSoup& soup,
                                                         const Orientation& orientation,
                                                         const RepairOptions& options,
                                                         SavedStates& states, RepairReport& report,
                                                         StageMeter& meter);

// The boundary between the cells that are solid and the others, simplified and certified as the
// options say: the first attempt that passes, else the one with the fewest faults. `covered` is
// destroyed as soon as it is not needed any more; its soup has to outlive the call.
[[nodiscard]] Surface make_surface(CoveredCells covered, const std::vector<char>& solid,
                                   const RepairOptions& options, RepairReport& report,
                                   StageMeter& meter);

// Simplifies and certifies a surface that was extracted from the cells of `input`, and describes
// it.
[[nodiscard]] Surface finish_surface(const CleanSoup& input, Surface surface,
                                     const RepairOptions& options, RepairReport& report,
                                     StageMeter& meter);

}  // namespace meshrepair::internal
