// SPDX-License-Identifier: MIT
// The frame of every program: command line, logging, signals, threads, report and exit code.
//
//   int main(int argc, char** argv) {
//     Program program("bspbuild", "Builds the BSP tree of a mesh.", "  bspbuild in.stl -o
//     out.bsp\n"); program.command_line().add_option("IN", options.input, "Mesh")->required();
//     return program.run(argc, argv, [&](Run& run) { ...; return ExitCode::done; });
//   }
#pragma once

#include <exception>
#include <functional>
#include <string>
#include <utility>

#include "options/command_line.h"
#include "process/exit_code.h"
#include "process/progress_bar.h"
#include "program/common_options.h"
#include "report/json_report.h"

namespace meshrepair {

// What the body of a program works with.
struct Run {
  JsonReport& report;
  ProgressBar& progress;
  const CommonOptions& options;
};

class Program {
 public:
  using Body = std::function<ExitCode(Run&)>;

  // `examples`: lines for the end of the help text, indented by two spaces, each ending with a
  // newline.
  Program(const std::string& name, const std::string& description, const std::string& examples);

  // For the program's own options, to be added before run().
  [[nodiscard]] CommandLine& command_line() { return command_line_; }

  // For a body whose program has another option for --report -. Throws UsageError if a file was
  // named by --report.
  void report_to_standard_output();
  // For whoever calls run() and wants the report, too: `take` gets it at the end, also of a wrong
  // command line, whatever --report says.
  void hand_report_to(std::function<void(const Json&)> take) { take_report_ = std::move(take); }
  // Adds the common options, with other defaults: what run() does before it reads the command line.
  void add_common_options(const CommonOptions& defaults);

  // Parses, runs `body`, writes the report whatever happened, and returns the exit code. The report
  // that cannot be written turns success into ExitCode::output.
  [[nodiscard]] int run(int argc, const char* const* argv, const Body& body);

 private:
  void add_common_options();
  ExitCode run_and_report(int argc, const char* const* argv, const Body& body);
  bool parse(int argc, const char* const* argv);
  void write_report(const JsonReport& report, ExitCode code, const std::exception_ptr& error,
                    ProgressBar& progress) const;

  CommandLine command_line_;
  CommonOptions options_;
  bool has_common_options_ = false;
  std::function<void(const Json&)> take_report_;
};

}  // namespace meshrepair
