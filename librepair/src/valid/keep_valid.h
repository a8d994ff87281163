// SPDX-License-Identifier: MIT
// Repairs that need no cells. None of these does anything where RepairOptions::all_cells asks for
// cells; where they give a surface, the report is complete but for its stages.
#pragma once

#include <optional>

#include <base/stage_meter.h>
#include <bsp/clean_soup.h>
#include <extract/surface.h>
#include <mesh/soup.h>
#include <repair/orient_parts.h>
#include <repair/repair_options.h>
#include <repair/repair_report.h>
#include <repair/valid_solid.h>

namespace meshrepair::internal {

// Whether cells may be spared: else they are asked for themselves, or tell more than the surface.
// Where they may, opacity tells nothing: what is solid is a matter of fact.
[[nodiscard]] bool may_spare_cells(const RepairOptions& options);

// The soup, if it is the boundary of a solid; else what `invalid` is set to was found, if it was
// looked for.
[[nodiscard]] std::optional<Surface> keep_as_given(const TriangleSoup& soup,
                                                   const RepairOptions& options,
                                                   RepairReport& report, StageMeter& meter,
                                                   std::optional<Invalid>& invalid);

// The clean soup with its holes closed and turned as `orientation` says, if that is one. `invalid`:
// what was found of the soup before; where triangles met and all are as they were, they still do.
[[nodiscard]] std::optional<Surface> keep_mended(const CleanSoup& soup,
                                                 const Orientation& orientation,
                                                 std::optional<Invalid> invalid,
                                                 const RepairOptions& options, RepairReport& report,
                                                 StageMeter& meter);

}  // namespace meshrepair::internal
