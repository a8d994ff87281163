// SPDX-License-Identifier: MIT
// The options that every program has, and how its command line is parsed.
#pragma once

#include <cstddef>
#include <string>

#include "options/command_line.h"
#include "terminal/logging.h"

namespace meshrepair {

struct CommonOptions {
  std::string report;         // file for the JSON report, "-" is stdout, empty is none
  bool hands_report = false;  // to whoever runs the program
  bool quiet = false;
  bool verbose = false;
  unsigned threads = 0;            // 0: all that the machine has
  double time_limit = 0;           // seconds, 0: none
  std::string max_memory = "80%";  // see parse_memory_limit
  std::string temp;                // a folder for what is more; empty: one of the system, "none"
  std::size_t max_triangles = 0;   // of a mesh that is read, 0: any number
  int progress_to = -1;            // a descriptor; -1: none

  [[nodiscard]] Verbosity verbosity() const;
  // Whether anybody sees the report, so that what is only for it is worth its time.
  [[nodiscard]] bool wants_report() const { return hands_report || !report.empty(); }
};

// Adds the options above, --version, --help, and --describe, which help does not show: a manual
// page or a completion, made of all options of the app. Call it after the program's own options:
// the groups appear in help in the order in which they were added.
void add_common_options(CommandLine& app, CommonOptions& options);

// True if the program is to go on, false if it was asked for help or version, which are then on
// stdout. Throws UsageError.
[[nodiscard]] bool parse_command_line(CommandLine& app, int argc, const char* const* argv);

// The value of --report found without parsing, so that a report can say what was wrong with the
// command line; empty if there is none, or if it is the value of another argument as well: the
// report is not to replace the input.
[[nodiscard]] std::string find_report_option(int argc, const char* const* argv);

}  // namespace meshrepair
