// The sections that findings make in the JSON report (README.md, "Report").
#pragma once

#include "common/json_report.h"
#include "common/repair_steps.h"

namespace meshrepair {

// One section for each part of the work that was begun.
void add_sections(const Findings& findings, JsonReport& report);

}  // namespace meshrepair
