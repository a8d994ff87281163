// SPDX-License-Identifier: MIT
// What a program did, in a few lines for people.
#pragma once

#include <string>

#include "program/program.h"
#include "report/findings.h"

namespace meshrepair {

// A dozen aligned lines or so: what was read, what was wrong with it, how it was decided what is
// solid, and what came out, each as far as it is known. `seconds` is the time that it all took.
[[nodiscard]] std::string summary_of(const Findings& findings, double seconds);

// Of these the lines that say what floating predicates did; nothing of exact ones.
[[nodiscard]] std::string predicates_summary(const RepairReport& repair);

// Of these the line that says which gaps were joined; nothing where none were.
[[nodiscard]] std::string gaps_summary(const RepairReport& repair);

// Of these the lines that say what --for has set; nothing without it.
[[nodiscard]] std::string purpose_summary(const Purpose& purpose);

// Of these, each text with the mesh's name before it, those of openings that were sealed and of
// sheets that were thickened; nothing where there are none.
[[nodiscard]] std::string walls_summary(const std::string& mesh, const RepairReport& repair);

// Clears the progress bar and prints the summary to stderr, unless the run is to be quiet.
void print_summary(Run& run, const Findings& findings);

}  // namespace meshrepair
