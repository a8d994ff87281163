// SPDX-License-Identifier: MIT
// The sections that findings make in the JSON report (docs/report.schema.json).
#pragma once

#include <vector>

#include <base/stage_meter.h>
#include <base/warning.h>

#include "report/findings.h"
#include "report/json_report.h"

namespace meshrepair {

// One section for each part of the work that was begun.
void add_sections(const Findings& findings, JsonReport& report);

// Name, times and peak of each.
[[nodiscard]] Json stages_section(const std::vector<StageReport>& stages);

// Without the codes.
[[nodiscard]] Json texts_of(const std::vector<Warning>& warnings);

// What a reader found in one mesh, as in the section "read".
[[nodiscard]] Json read_section(const ReadReport& read);

}  // namespace meshrepair
