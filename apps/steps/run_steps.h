// SPDX-License-Identifier: MIT
// How a program that repairs runs: files are checked first, findings are reported whatever happens,
// and the summary comes last.
#pragma once

#include <functional>

#include "program/program.h"
#include "report/findings.h"
#include "steps/step_options.h"

namespace meshrepair {

using StepBody = std::function<void(const StepOptions&, Run&, Findings&)>;

// The whole of a program once its options are declared: looks at the files before hours of work,
// runs `body`, puts what was found into the report, also when it throws, and prints the summary.
// Errors about the input that do not name it are given its name. The report never goes where the
// input or the output is. Exit code "done" of a program that writes a mesh means that the mesh
// holds all guarantees that were checked; what it does not hold is said on stderr.
[[nodiscard]] int run_steps(Program& program, int argc, const char* const* argv,
                            StepOptions& options, const StepBody& body);
// The same within a run that is there already.
[[nodiscard]] ExitCode run_steps(StepOptions& options, Run& run, const StepBody& body);

// Runs `work`, then puts the findings into the report, also when it throws. Errors about the input
// that do not name it are given its name.
ExitCode with_findings(Run& run, Findings& findings, const std::function<ExitCode()>& work);

}  // namespace meshrepair
