// Bodies that are hollow by mistake become full.
#pragma once

#include <optional>

#include <extract/surface.h>
#include <repair/repair_options.h>
#include <repair/repair_report.h>

#include "seal_body.h"

namespace meshrepair::internal {

// The solid without the inner walls that find_double_walls() finds, its pinholes closed by patches,
// certified if `options` ask for that; all other triangles stay as they are. Nothing if there are
// none, or if no such solid comes of it (SealReport::cannot_cut). `report` is that of the repair
// that the solid came of, and is brought up to date.
[[nodiscard]] std::optional<Sealed> fill_double_walls(const Surface& solid,
                                                      const RepairOptions& options,
                                                      const RepairAgain& repair_again,
                                                      RepairReport& report);

}  // namespace meshrepair::internal
