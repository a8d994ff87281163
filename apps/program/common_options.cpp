// SPDX-License-Identifier: MIT
#include "program/common_options.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <base/error.h>
#include <base/internal/system.h>

#include "describe/build_facts.h"
#include "describe/completions.h"
#include "describe/man_page.h"
#include "options/choice_option.h"
#include "options/file_kinds.h"
#include "options/numbers.h"

namespace meshrepair {
namespace {

constexpr std::string_view kReportOption = "--report";
constexpr std::size_t kMostDescriptor = 1 << 20;

// What --describe prints.
struct Description {
  std::string text;
};

using Describe = std::string (*)(const CommandFacts&);
constexpr std::array<Choice<Describe>, 4> kDescriptions = {{{"man", man_page},
                                                            {"bash", bash_completion},
                                                            {"zsh", zsh_completion},
                                                            {"fish", fish_completion}}};

// For check(): an empty text where `text` is a time to wait.
std::string why_no_duration(const std::string& text) {
  const std::optional<double> seconds = parse_number(text);
  if (seconds && *seconds >= 0) return {};
  return text + " is not a number of seconds, 0 or more";
}

std::string why_no_count(const std::string& text) {
  return parse_count(text) ? std::string() : "'" + text + "' is not a number, 0 or more";
}

std::string why_no_descriptor(const std::string& text) {
  const std::optional<std::size_t> number = parse_count(text);
  const bool is_open =
      number && *number <= kMostDescriptor && internal::is_open(static_cast<int>(*number));
  return is_open ? std::string() : "'" + text + "' is not the number of an open descriptor";
}

// Some programs have --json for their report.
void add_json_flag(CommandLine& app, CommandOption& version) {
  const std::string facts = "print version, build, libraries, formats and limits as JSON";
  if (CommandOption* known = app.find("--json")) {
    known->description(known->description() + ";\nwith --version: " + facts);
    return;
  }
  const std::string alone = "With --version: " + facts;
  app.add_flag_callback(
         "--json", [] {}, alone)
      ->needs(&version)
      ->group("Reporting");
}

// --version ends the parsing before other options are looked at.
std::string version_text(const CommandLine& app) {
  if (app.option("--json").count() == 0) return app.name() + " " + program_version() + "\n";
  return build_facts(app.name()).dump(2) + "\n";
}

std::string_view report_value(const std::vector<std::string_view>& arguments) {
  for (std::size_t i = 0; i < arguments.size() && arguments[i] != "--"; ++i) {
    if (arguments[i].substr(0, kReportOption.size() + 1) == "--report=") {
      return arguments[i].substr(kReportOption.size() + 1);
    }
    if (arguments[i] != kReportOption || i + 1 == arguments.size()) continue;
    const std::string_view value = arguments[i + 1];
    if (value == "-" || (!value.empty() && value.front() != '-')) return value;
  }
  return {};
}

void add_running_options(CommandLine& app, CommonOptions& options) {
  const std::string running = "Running";
  app.add_option("--threads", options.threads, "Number of threads; 0: all")
      ->capture_default_str()
      ->check(count_between(0, kMostThreads))
      ->type_name("N")
      ->group(running);
  app.add_option("--time-limit", options.time_limit, "Stop after this time; 0: no limit")
      ->capture_default_str()
      ->check(why_no_duration)
      ->type_name("SECONDS")
      ->group(running);
  app.add_option("--max-memory", options.max_memory,
                 "Use at most this much memory: 200M, 1.5G, or a percentage of free memory; large\n"
                 "arrays beyond it go into a temporary file; 0: no limit")
      ->capture_default_str()
      ->type_name("SIZE")
      ->group(running);
  app.add_option(
         "--temp", options.temp,
         "Folder for the temporary file, $TMPDIR or /var/tmp if not given; none: stop when\n"
         "the memory limit is reached")
      ->type_name("DIR")
      ->group(running);
  app.add_option_function(
         "--max-triangles",
         [&options](const std::string& text) { options.max_triangles = *parse_count(text); },
         "Reject inputs with more triangles; 0: no limit")
      ->default_str("0")
      ->check(why_no_count)
      ->type_name("N")
      ->group(running)
      ->rare();
}

void add_telling_options(CommandLine& app, CommonOptions& options) {
  const std::string telling = "Reporting";
  app.add_option("--progress-fd", options.progress_to,
                 "Write a line 'STAGE PERCENT' for each percent to this open file descriptor,\n"
                 "for programs that call this one")
      ->check(why_no_descriptor)
      ->type_name("N")
      ->group(telling)
      ->rare();
  app.add_option("--report", options.report, "Write a report as JSON; - is standard output")
      ->check(names_side_file(".json"))
      ->type_name("FILE")
      ->group(telling);
  CommandOption* quiet =
      app.add_flag("--quiet,-q", options.quiet, "Print errors only")->group(telling);
  app.add_flag("--verbose,-v", options.verbose, "Print what each step does")
      ->excludes(quiet)
      ->group(telling);
  CommandOption* version =
      app.set_version_flag("--version", "Print the version and exit")->group(telling);
  add_json_flag(app, *version);
  app.set_help_flag("--help,-h", "Print this help and exit")->group(telling);
  app.set_help_all_flag("--help-all", "Print the help of all options, also of those that few need")
      ->group(telling);
  add_choice(
      app, "--describe", kDescriptions,
      [&app](Describe describe) { throw Description{describe(facts_of(app))}; },
      "Print a manual page or a shell completion")
      ->group("");
}

}  // namespace

Verbosity CommonOptions::verbosity() const {
  if (quiet) return Verbosity::quiet;
  return verbose ? Verbosity::verbose : Verbosity::normal;
}

void add_common_options(CommandLine& app, CommonOptions& options) {
  add_running_options(app, options);
  add_telling_options(app, options);
}

bool parse_command_line(CommandLine& app, int argc, const char* const* argv) {
  try {
    switch (app.parse(argc, argv)) {
      case CommandLine::Parsed::all:
        return true;
      case CommandLine::Parsed::help:
        std::fputs(app.help().c_str(), stdout);
        return false;
      case CommandLine::Parsed::help_all:
        std::fputs(app.help_all().c_str(), stdout);
        return false;
      case CommandLine::Parsed::version:
        std::fputs(version_text(app).c_str(), stdout);
        return false;
    }
  } catch (const Description& description) {
    std::fputs(description.text.c_str(), stdout);
  }
  return false;
}

std::string find_report_option(int argc, const char* const* argv) {
  const std::vector<std::string_view> arguments(argv + 1, argv + argc);
  const std::string_view value = report_value(arguments);
  const auto others = std::count(arguments.begin(), arguments.end(), value);
  const bool is_own_argument =
      std::find(arguments.begin(), arguments.end(), kReportOption) != arguments.end();
  return others > (is_own_argument ? 1 : 0) ? std::string() : std::string(value);
}

}  // namespace meshrepair
