#include "common/program.h"

#include <algorithm>
#include <exception>
#include <new>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <thread>

#include <spdlog/spdlog.h>
#include <tbb/global_control.h>

#include <base/atomic_file.h>
#include <base/error.h>

#include "common/logging.h"
#include "common/memory_limit.h"
#include "common/signals.h"
#include "common/watchdog.h"

namespace meshrepair {
namespace {

// As many as there will be: 0 stands for all that the machine has.
unsigned thread_count(unsigned threads) {
  return threads != 0 ? threads : std::max(1U, std::thread::hardware_concurrency());
}

std::optional<tbb::global_control> limit_threads(unsigned threads) {
  if (threads == 0) return std::nullopt;
  return std::optional<tbb::global_control>(std::in_place,
                                            tbb::global_control::max_allowed_parallelism, threads);
}

// What TBB throws where the system gives it no thread, for want of memory or by a limit of its own.
bool is_lack_of_threads(const std::runtime_error& error) {
  return std::string_view(error.what()).find("pthread_create") != std::string_view::npos;
}

ProgressBar::Options bar_options(const CommonOptions& options, const MemoryLimit& memory) {
  ProgressBar::Options bar;
  bar.draw = !options.quiet && stderr_is_terminal();
  bar.time_limit = options.time_limit;
  bar.memory_limit = memory.bytes;
  return bar;
}

}  // namespace

Program::Program(const std::string& name, const std::string& description,
                 const std::string& examples)
    : command_line_(description, name) {
  command_line_.footer("Examples:\n" + examples.substr(0, examples.find_last_not_of('\n') + 1));
}

void Program::report_to_standard_output() {
  if (!options_.report.empty() && options_.report != "-") {
    throw UsageError("--report: excludes --json, which prints the report");
  }
  options_.report = "-";
}

int Program::run(int argc, const char* const* argv, const Body& body) {
  return run_guarded(command_line_.get_name(), [&] {
    install_signal_handlers();
    set_up_logging(command_line_.get_name(), Verbosity::normal);
    return run_and_report(argc, argv, body);
  });
}

ExitCode Program::run_and_report(int argc, const char* const* argv, const Body& body) {
  JsonReport report(command_line_.get_name(), std::vector<std::string>(argv, argv + argc));
  std::optional<ProgressBar> progress(std::in_place);
  std::optional<Watchdog> watchdog;
  ExitCode code = ExitCode::done;
  std::exception_ptr error;
  try {
    add_common_options(command_line_, options_);
    if (!parse(argc, argv)) return ExitCode::done;
    set_up_logging(command_line_.get_name(), options_.verbosity());
    const MemoryLimit memory = parse_memory_limit(options_.max_memory);
    progress.emplace(bar_options(options_, memory));
    watchdog.emplace(command_line_.get_name(), *progress);
    limit_memory(memory, thread_count(options_.threads));
    const auto thread_limit = limit_threads(options_.threads);
    Run run{report, *progress, options_};
    code = body(run);
    flush_standard_output();
  } catch (const std::bad_alloc&) {
    error = std::make_exception_ptr(LimitError(progress->out_of_memory()));
  } catch (const std::runtime_error& e) {
    error = std::current_exception();
    if (is_lack_of_threads(e)) error = std::make_exception_ptr(progress->out_of_threads());
  } catch (...) {
    error = std::current_exception();
  }
  progress->finish();
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
  if (options_.report.empty() || report.withheld()) return;
  std::optional<Failure> failure;
  if (error) failure = describe_failure(error);
  const std::string text = report.text(failure ? failure->code : code, failure, progress);
  try {
    write_file_atomically(options_.report, text, error ? nullptr : &progress);
  } catch (const OutputError& e) {
    if (!error) throw;
    spdlog::warn("no report: {}", e.what());
  }
}

}  // namespace meshrepair
