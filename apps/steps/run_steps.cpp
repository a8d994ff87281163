// SPDX-License-Identifier: MIT
#include "steps/run_steps.h"

#include <filesystem>
#include <string>

#include <base/error.h>

#include "page/html_report.h"
#include "pictures/explanation_file.h"
#include "pictures/picture_steps.h"
#include "program/command_files.h"
#include "report/report_sections.h"
#include "steps/guarantees.h"
#include "summary/summary.h"
#include "summary/warnings.h"

namespace meshrepair {
namespace {

namespace fs = std::filesystem;

template <class ErrorType>
[[noreturn]] void rethrow_named(const ErrorType& error, const std::string& name) {
  const std::string message = error.what();
  if (message.rfind(name, 0) == 0) throw error;
  throw ErrorType(name + ": " + message);
}

void run_named(const std::string& name, const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& error) {
    rethrow_named(error, name);
  } catch (const NoSolidError& error) {
    rethrow_named(error, name);
  }
}

// Where OUT is written first.
std::string written_first(const StepOptions& options) {
  if (options.staging.empty()) return options.output;
  if (options.output == "-") throw UsageError("--staging: standard output is no file");
  return (fs::path(options.staging) / fs::path(options.output).filename()).string();
}

ExitCode run_body(const StepOptions& options, Run& run, const StepBody& body) {
  Findings findings(options.input, options.output);
  findings.purpose = options.purpose;
  findings.wants_fidelity = asks_for_distance(options.required);
  (void)with_findings(run, findings, [&] {
    body(options, run, findings);
    return ExitCode::done;
  });
  warn_of_findings(findings);
  if (!findings.withheld) print_summary(run, findings);
  return verdict(run, findings);
}

}  // namespace

ExitCode with_findings(Run& run, Findings& findings, const std::function<ExitCode()>& work) {
  run.report.set_input({{"path", findings.input}});
  ExitCode code = ExitCode::internal;
  try {
    run_named(findings.input_name(), [&] { code = work(); });
  } catch (...) {
    warn_of_coarse_grid(findings);
    add_sections(findings, run.report);
    throw;
  }
  add_sections(findings, run.report);
  return code;
}

int run_steps(Program& program, int argc, const char* const* argv, StepOptions& options,
              const StepBody& body) {
  return program.run(argc, argv, [&](Run& run) { return run_steps(options, run, body); });
}

ExitCode run_steps(StepOptions& options, Run& run, const StepBody& body) {
  if (options.output.empty()) throw UsageError("the name of the output is empty");
  check_files(options.input, written_first(options), run);
  check_picture(options.picture, {options.input, options.output}, run);
  check_explanation(options.explained, {options.input, options.output, options.picture.path}, run);
  check_html(options.html, {options.input, options.output, options.picture.path, options.explained},
             run);
  options.repair.progress = &run.progress;
  return run_body(options, run, body);
}

}  // namespace meshrepair
