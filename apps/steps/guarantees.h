// SPDX-License-Identifier: MIT
// Which guarantees the written file holds, and the exit code that says so.
#pragma once

#include <string>

#include <extract/surface.h>
#include <mesh/soup_format.h>

#include "program/program.h"
#include "report/findings.h"

namespace meshrepair {

// What counts is the file: in STL, welding and rounding may join what the surface keeps apart.
void look_at_file(const Surface& surface, SoupFormat format, Findings& findings);

// What a surface lacks in the file, for people; empty: nothing. After look_at_file().
[[nodiscard]] std::string missing_guarantees(const Findings& findings, SoupFormat format);

// Not certified, and errors logged and put into the report, where the output is without a guarantee
// or does not meet a requirement.
[[nodiscard]] ExitCode verdict(Run& run, const Findings& findings);

}  // namespace meshrepair
