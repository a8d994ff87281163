// SPDX-License-Identifier: MIT
// The surface between solid and empty without cells: triangles that meet are cut in their own
// planes.
#pragma once

#include <optional>
#include <vector>

#include <base/stage_meter.h>
#include <bsp/clean_soup.h>
#include <extract/arrange.h>
#include <extract/surface.h>
#include <repair/orient_parts.h>
#include <repair/repair_options.h>
#include <repair/repair_report.h>

namespace meshrepair::internal {

// The surface of the solid that all cells would give, if the soup is closed but for little: the
// regions into which its triangles divide space are labelled as cells are. Nothing if sheets have
// the same region on both sides, if solidity or parity contradicts itself, if sheets are so near to
// each other that cells would fill what is between, or in rare cases (Arrangement); then the report
// may hold what was found so far.
[[nodiscard]] std::optional<Surface> surface_of_chambers(const CleanSoup& soup,
                                                         const Orientation& orientation,
                                                         const RepairOptions& options,
                                                         RepairReport& report, StageMeter& meter);

// The boundary between chambers that are solid, of each a flag, and the others. Nothing where
// sheets are so near to each other that cells would fill what is between, or in rare cases.
[[nodiscard]] std::optional<Surface> boundary_of_chambers(const CleanSoup& soup,
                                                          const Arrangement& arrangement,
                                                          const std::vector<char>& solid,
                                                          const RepairOptions& options,
                                                          RepairReport& report);

}  // namespace meshrepair::internal
