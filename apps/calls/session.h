// SPDX-License-Identifier: MIT
// The frame of a call from another language: what Program is for a command line. Options have the
// names and values of the programs' long ones, and come out of the same tables.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "calls/call_progress.h"
#include "options/command_line.h"
#include "process/exit_code.h"
#include "program/common_options.h"
#include "program/program.h"

namespace meshrepair {

// Of one option: its name, which may have "_" for "-", and its value as the command line would have
// it, or for flags whether they are set.
using Keyword = std::pair<std::string, std::variant<bool, std::string>>;
using Keywords = std::vector<Keyword>;

// What came of a call, whether it went well or not.
struct Outcome {
  ExitCode code = ExitCode::internal;
  std::string error;                  // one line; empty where nothing was wrong
  std::string report;                 // JSON
  std::vector<std::string> warnings;  // with their codes; the report has their numbers, too
};

class Session {
 public:
  using Body = std::function<ExitCode(Run&)>;

  // `program`: whose options and report these are.
  explicit Session(const std::string& program);

  // For the options of the program, to be added before parse().
  [[nodiscard]] CommandLine& options() { return app_; }
  [[nodiscard]] CommonOptions& common() { return common_; }

  // Throws UsageError, which begins with the name as it is in the keyword; also for those that are
  // among `refused`: they are about files, and there are none.
  void parse(const Keywords& keywords, const std::vector<std::string_view>& refused);

  // As the options say; what the observer of run() is made with.
  [[nodiscard]] ProgressBar::Options limits() const;

  // Whatever the body throws is in the outcome.
  [[nodiscard]] Outcome run(CallProgress& progress, const Body& body) const;

 private:
  CommandLine app_;
  CommonOptions common_;
  std::vector<std::string> command_;  // as the command line would be
};

// How a caller has the body of a session run: on a thread of which kind, and who is told.
using Runner = std::function<Outcome(const Session&, const Session::Body&)>;

}  // namespace meshrepair
