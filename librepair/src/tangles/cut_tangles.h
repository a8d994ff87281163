// Repairs that make cells only where triangles meet.
#pragma once

#include <optional>

#include <base/stage_meter.h>
#include <bsp/clean_soup.h>
#include <extract/surface.h>
#include <repair/orient_parts.h>
#include <repair/repair_options.h>
#include <repair/repair_report.h>

namespace meshrepair::internal {

// The boundary, not finished yet, of the solid that all cells would give, if the soup is closed and
// turned consistently, and meets itself in few triangles: those that nothing meets are kept as they
// are, or left out. Not with RepairOptions::all_cells, and only where the places that are cut
// tell all that there is to decide (label_tangles()); else nothing.
[[nodiscard]] std::optional<Surface> cut_tangles(const CleanSoup& soup,
                                                 const Orientation& orientation,
                                                 const RepairOptions& options, RepairReport& report,
                                                 StageMeter& meter);

}  // namespace meshrepair::internal
