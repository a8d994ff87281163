// SPDX-License-Identifier: MIT
// What a ball cannot come to becomes solid, and so do bodies that are hollow by mistake.
#pragma once

#include <optional>

#include <extract/surface.h>
#include <mesh/soup.h>
#include <repair/repair_options.h>
#include <repair/repair_report.h>

#include "seal_body.h"

namespace meshrepair::internal {

// Seals the openings of a solid as `options.seal` says, see seal_openings.h, and brings the report
// of the repair that it came of up to date. A solid without such openings stays as it is. `soup` is
// what was repaired. Throws UsageError where the size is too small for the solid.
[[nodiscard]] Surface seal_solid(const TriangleSoup& soup, Surface solid,
                                 const RepairOptions& options, const RepairAgain& repair_again,
                                 RepairReport& report);

// The solid without the inner walls that find_double_walls() finds, its pinholes closed by patches,
// certified if `options` ask for that; all other triangles stay as they are. Nothing if there are
// none, or if no such solid comes of it (SealReport::cannot_cut). `report` is that of the repair
// that the solid came of, and is brought up to date.
[[nodiscard]] std::optional<Sealed> fill_double_walls(const Surface& solid,
                                                      const RepairOptions& options,
                                                      const RepairAgain& repair_again,
                                                      RepairReport& report);

}  // namespace meshrepair::internal
