// SPDX-License-Identifier: MIT
#include "program/program.h"

#include <exception>
#include <new>
#include <optional>

#include <spdlog/fmt/fmt.h>
#include <spdlog/logger.h>

#include <base/atomic_file.h>
#include <base/error.h>
#include <base/parallel.h>

#include "process/memory_limit.h"
#include "process/signals.h"
#include "process/watchdog.h"
#include "spill/spilling.h"
#include "terminal/logging.h"
#include "terminal/warning_log.h"

namespace meshrepair {
namespace {

ProgressBar::Options bar_options(const CommonOptions& options, const MemoryLimit& memory,
                                 const Spilling& spilling) {
  ProgressBar::Options bar;
  bar.draw = !options.quiet && stderr_is_terminal();
  bar.time_limit = options.time_limit;
  bar.memory_limit = memory.bytes;
  bar.spills = spilling.is_on();
  bar.told = options.progress_to;
  return bar;
}

}  // namespace

Program::Program(const std::string& name, const std::string& description,
                 const std::string& examples)
    : command_line_(description, name) {
  command_line_.set_footer("Examples:\n" + examples.substr(0, examples.find_last_not_of('\n') + 1));
}

void Program::report_to_standard_output() {
  if (!options_.report.empty() && options_.report != "-") {
    throw UsageError("--report: excludes --json, which prints the report");
  }
  options_.report = "-";
}

void Program::add_common_options(const CommonOptions& defaults) {
  options_ = defaults;
  add_common_options();
}

void Program::add_common_options() {
  if (has_common_options_) return;
  meshrepair::add_common_options(command_line_, options_);
  has_common_options_ = true;
}

int Program::run(int argc, const char* const* argv, const Body& body) {
  return run_guarded(command_line_.name(), [&] {
    install_signal_handlers();
    set_up_logging(command_line_.name(), Verbosity::normal);
    return run_and_report(argc, argv, body);
  });
}

ExitCode Program::run_and_report(int argc, const char* const* argv, const Body& body) {
  JsonReport report(command_line_.name(), std::vector<std::string>(argv, argv + argc));
  std::optional<ProgressBar> progress(std::in_place);
  std::optional<Watchdog> watchdog;
  std::optional<Spilling> spilling;
  ExitCode code = ExitCode::done;
  std::exception_ptr error;
  const WarningLog warnings;
  try {
    add_common_options();
    if (!parse(argc, argv)) return ExitCode::done;
    set_up_logging(command_line_.name(), options_.verbosity());
    const MemoryLimit memory = parse_memory_limit(options_.max_memory);
    const ThreadLimit thread_limit(options_.threads);
    spilling.emplace(options_.temp, memory);
    progress.emplace(bar_options(options_, memory, *spilling));
    watchdog.emplace(command_line_.name(), *progress);
    limit_memory(memory, most_threads());
    logger().debug("threads: {}", most_threads());
    Run run{report, *progress, options_};
    code = body(run);
    flush_standard_output();
  } catch (const std::bad_alloc&) {
    error = std::make_exception_ptr(
        LimitError(progress->out_of_memory() + (spilling ? spilling->why_not_more() : "")));
  } catch (const OutOfThreads&) {
    error = std::make_exception_ptr(progress->out_of_threads());
  } catch (...) {
    error = std::current_exception();
  }
  progress->finish();
  show_held_warnings();
  report.set_warnings(warnings.told());
  if (spilling && spilling->most_bytes() > 0) {
    report.set_section("temp_file", {{"bytes", spilling->most_bytes()}});
  }
  write_report(report, code, error, *progress);
  if (error) std::rethrow_exception(error);
  return code;
}

// After a mistake on the command line the report goes only where it can replace nothing else.
bool Program::parse(int argc, const char* const* argv) {
  try {
    return parse_command_line(command_line_, argc, argv);
  } catch (const UsageError&) {
    options_.report = find_report_option(argc, argv);
    throw;
  }
}

// An error of the run outweighs one of its report.
void Program::write_report(const JsonReport& report, ExitCode code, const std::exception_ptr& error,
                           ProgressBar& progress) const {
  const bool is_written = !options_.report.empty() && !report.withheld();
  if (!is_written && !take_report_) return;
  std::optional<Failure> failure;
  if (error) failure = describe_failure(error);
  const Json json = report.json(failure ? failure->code : code, failure, progress);
  if (take_report_) take_report_(json);
  if (!is_written) return;
  try {
    write_file_atomically(options_.report, JsonReport::text_of(json), error ? nullptr : &progress);
  } catch (const OutputError& e) {
    if (!error) throw;
    warn("", {WarningCode::report_not_written, fmt::format("no report: {}", e.what())});
  }
}

}  // namespace meshrepair
