// SPDX-License-Identifier: MIT
// Negative volumes of slicers' projects.
#pragma once

#include <cstdint>
#include <vector>

#include <repair/repair_options.h>

#include "program/program.h"
#include "report/findings.h"
#include "steps/point_steps.h"

namespace meshrepair {

// Stage "negative", where the input has such volumes: takes them off the other volumes of their
// object, of which it makes solids before. What encloses nothing is not subtracted, with a warning.
// Returns of each triangle of the input where it was before, or Surface::kNoSource; nothing where
// the input stays as it is. Throws NoSolidError where nothing is left.
[[nodiscard]] std::vector<std::uint32_t> subtract_negatives_stage(AnySoup& input,
                                                                  const RepairOptions& options,
                                                                  Run& run, Findings& findings);

}  // namespace meshrepair
