// SPDX-License-Identifier: MIT
// From what a repair left of a soup to the same with walls for its sheets.
#pragma once

#include <optional>

#include <bsp/clean_soup.h>
#include <extract/surface.h>
#include <repair/repair_options.h>
#include <repair/repair_report.h>

#include "again/second_repair.h"

namespace meshrepair::internal {

// For the repair that tells solids from sheets: large holes are left open. Throws UsageError where
// the thickness is none.
[[nodiscard]] RepairOptions options_for_sheets(const RepairOptions& options);

// What is to be united: closed surfaces, of which that is solid what they wind around. `soup` is
// what was repaired, and `solids` came of that, if anything is solid. Empty if it has no
// sheets. Sets what the report says about parts and walls. Throws UsageError where walls are
// thinner than numbers tell, or thicker.
[[nodiscard]] SecondSoup add_walls(const CleanSoup& soup, const std::optional<Surface>& solids,
                                   const RepairOptions& options, RepairReport& report);

// Brings the surface that this gave, and its report, back to the soup that was given. `report` says
// what was found in that, and becomes the report of the whole.
void finish_walls(const CleanSoup& soup, const SecondSoup& walled, RepairReport united,
                  Surface& surface, RepairReport& report);

// Where nothing is solid, a thickness for walls that fits the mesh: ThickenReport::fitting.
[[nodiscard]] double thickness_that_fits(const CleanSoup& soup);

}  // namespace meshrepair::internal
