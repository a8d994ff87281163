// SPDX-License-Identifier: MIT
// What a program is built of, and what it knows: for reports of faults, and for packagers.
#pragma once

#include <string>

#include "report/json_report.h"

namespace meshrepair {

// Version, compiler, libraries, formats and limits, as docs/stability.md lists them.
[[nodiscard]] Json build_facts(const std::string& program);

}  // namespace meshrepair
