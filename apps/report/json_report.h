// SPDX-License-Identifier: MIT
// The JSON report of a run: one object, the same frame for every program, written on failure too.
//
//   program       name
//   version       of the project
//   command       the command line, one string per argument
//   input         what was read, or null
//   output        what was written, or null
//   ...           the program's own sections, in the order in which they were added
//   warnings      [{"code", "about", "text", "changes_object", "numbers"}]
//   stages        [{"name", "seconds"}], more of each where a program measures more
//   seconds       wall time of the whole run
//   peak_memory_bytes
//   exit_code     as returned by the process
//   error         the line on stderr without the program's name, or null
//
// Keys are snake_case; times are in seconds, sizes in bytes. A number that is not finite is null, a
// byte that is not UTF-8 (in a file's name) the replacement character.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "process/exit_code.h"
#include "process/progress_bar.h"
#include "report/json.h"
#include "terminal/warning_log.h"

namespace meshrepair {

// Of what reports hold: see docs/stability.md. It changes together with docs/report.schema.json.
inline constexpr std::string_view kReportVersion = "1.1";

// The version of the project, "1.2.3".
[[nodiscard]] std::string program_version();

// As the section "warnings" has them.
[[nodiscard]] Json warnings_section(const std::vector<ToldWarning>& warnings);

class JsonReport {
 public:
  JsonReport(const std::string& program, const std::vector<std::string>& command);

  void set_input(Json input);
  void set_output(Json output);
  // Adds a section, or replaces it. Pre: not one of the keys above.
  void set_section(const std::string& key, Json section);

  // What was told so far.
  void set_warnings(const std::vector<ToldWarning>& warnings);

  // Hands over all sections; the report is without them then.
  [[nodiscard]] Json take_sections();

  // The stages with what the program measured of each; without it they are those of the progress.
  void set_stages(Json stages);

  // What ended with an exit code other than 0, though nothing was thrown.
  void set_error(std::string message) { error_ = std::move(message); }
  [[nodiscard]] const std::optional<std::string>& error() const { return error_; }

  // The report is not to be written: its file is not one that may be replaced.
  void withhold() { withheld_ = true; }
  [[nodiscard]] bool withheld() const { return withheld_; }

  // The finished report. `failure` is what ended the run early, if anything did.
  [[nodiscard]] Json json(ExitCode code, const std::optional<Failure>& failure,
                          const ProgressBar& progress) const;
  // Its text, as it is written to a file.
  [[nodiscard]] std::string text(ExitCode code, const std::optional<Failure>& failure,
                                 const ProgressBar& progress) const {
    return text_of(json(code, failure, progress));
  }
  [[nodiscard]] static std::string text_of(const Json& report) { return report.dump(2) + '\n'; }

 private:
  Json head_;      // program to output
  Json sections_;  // the program's own
  Json warnings_;
  Json stages_;  // null: those of the progress
  std::optional<std::string> error_;
  bool withheld_ = false;
};

}  // namespace meshrepair
