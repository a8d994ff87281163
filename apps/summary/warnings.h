// SPDX-License-Identifier: MIT
// Warnings on standard error: what users should know, though it is no error.
#pragma once

#include "report/findings.h"

namespace meshrepair {

// What users should know of an input and of what became of it, though it is no error. Once.
void warn_of_findings(Findings& findings);
// Of these the one that matters also where the work failed: the grid swallows triangles because one
// point is too far off. The user can mend that, and would otherwise look for them in vain.
void warn_of_coarse_grid(const Findings& findings);

}  // namespace meshrepair
