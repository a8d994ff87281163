#include "common/common_options.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <fcntl.h>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <base/error.h>

#include "common/choice_option.h"
#include "common/file_kinds.h"
#include "common/numbers.h"
#include "describe/build_facts.h"
#include "describe/completions.h"
#include "describe/man_page.h"

namespace meshrepair {
namespace {

constexpr std::string_view kReportOption = "--report";
constexpr std::size_t kMostDescriptor = 1 << 20;

// What --describe prints.
class CallForDescription : public CLI::Success {
 public:
  explicit CallForDescription(std::string text)
      : Success("CallForDescription", std::move(text), CLI::ExitCodes::Success) {}
};

using Describe = std::string (*)(const CommandFacts&);
constexpr std::array<Choice<Describe>, 4> kDescriptions = {{{"man", man_page},
                                                            {"bash", bash_completion},
                                                            {"zsh", zsh_completion},
                                                            {"fish", fish_completion}}};

// Help in which an option is "--name TYPE", and what it does ends with its default.
class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter() { column_width(28); }

  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override {
    const std::string help = Formatter::make_help(app, std::move(name), mode);
    return CLI::detail::find_and_replace(help, "\n\n\n", "\n\n");
  }

  std::string make_option_opts(const CLI::Option* option) const override {
    const std::string type = option->get_type_name();  // "TYPE:check"
    if (option->get_positional() || option->get_type_size() == 0 || type.empty()) return {};
    return " " + type.substr(0, type.find(':'));
  }

  std::string make_option_desc(const CLI::Option* option) const override {
    const std::string value = option->get_default_str();
    if (value.empty()) return option->get_description();
    return option->get_description() + " (default: " + value + ")";
  }
};

// For CLI11: an empty text where `text` is a time to wait.
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
      number && *number <= kMostDescriptor && ::fcntl(static_cast<int>(*number), F_GETFD) != -1;
  return is_open ? std::string() : "'" + text + "' is not the number of an open descriptor";
}

// CLI11 looks for what is missing first: whoever mistypes the only option would be told of IN.
std::string message_of(const CLI::App& app, const CLI::RequiredError& error) {
  const std::vector<std::string> unknown = app.remaining();
  return unknown.empty() ? error.what() : CLI::ExtrasError(unknown).what();
}

// CLI11 says "At Most 1 required but received 2".
std::string message_of(const CLI::App& app, const CLI::ArgumentMismatch& error) {
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_type_size() == 0) continue;  // a flag may be there twice
    if (option->count() > static_cast<std::size_t>(option->get_items_expected_max())) {
      return option->get_name() + ": is given more than once";
    }
  }
  return error.what();
}

// Some programs have --json for their report.
void add_json_flag(CLI::App& app, CLI::Option& version) {
  const std::string facts = "print what the program is built of and knows, as JSON";
  if (CLI::Option* known = app.get_option_no_throw("--json")) {
    known->description(known->get_description() + ";\nwith --version: " + facts);
    return;
  }
  const std::string alone = "With --version: " + facts;
  app.add_flag("--json", alone)->needs(&version)->group("Reporting");
}

// --version ends the parsing before other options are looked at.
std::string version_text(const CLI::App& app, const CLI::CallForVersion& version) {
  if (app.count("--json") == 0) return std::string(version.what()) + "\n";
  return build_facts(app.get_name()).dump(2) + "\n";
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

}  // namespace

Verbosity CommonOptions::verbosity() const {
  if (quiet) return Verbosity::quiet;
  return verbose ? Verbosity::verbose : Verbosity::normal;
}

std::string program_version() { return MESHREPAIR_VERSION; }

void add_common_options(CLI::App& app, CommonOptions& options) {
  app.formatter(std::make_shared<HelpFormatter>());
  const std::string running = "Running";
  const std::string telling = "Reporting";
  app.add_option("--threads", options.threads, "Number of threads; 0: all")
      ->capture_default_str()
      ->check(count_between(0, kMostThreads))
      ->type_name("N")
      ->group(running);
  app.add_option("--time-limit", options.time_limit, "Give up after this time; 0: never")
      ->capture_default_str()
      ->check(why_no_duration)
      ->type_name("SECONDS")
      ->group(running);
  app.add_option("--max-memory", options.max_memory,
                 "Take no more memory: 200M, 1.5G, or a share of what is free; large\n"
                 "arrays go into a file where there would be more; 0: no limit")
      ->capture_default_str()
      ->type_name("SIZE")
      ->group(running);
  app.add_option("--temp", options.temp,
                 "Folder for this file; $TMPDIR or /var/tmp unless told; none: give up\n"
                 "rather than take more memory")
      ->type_name("DIR")
      ->group(running);
  app.add_option_function<std::string>(
         "--max-triangles",
         [&options](const std::string& text) { options.max_triangles = *parse_count(text); },
         "Give up on inputs of more triangles; 0: no limit")
      ->default_str("0")
      ->check(why_no_count)
      ->type_name("N")
      ->group(running);
  app.add_option("--progress-fd", options.progress_to,
                 "Write a line 'STAGE PERCENT' for each percent to this descriptor, which is\n"
                 "open, for programs that call this one")
      ->check(why_no_descriptor)
      ->type_name("N")
      ->group(telling);
  app.add_option("--report", options.report, "Write a report as JSON; - is standard output")
      ->check(names_side_file(".json"))
      ->type_name("FILE")
      ->group(telling);
  CLI::Option* quiet =
      app.add_flag("--quiet,-q", options.quiet, "Print errors only")->group(telling);
  app.add_flag("--verbose,-v", options.verbose, "Print what each step does")
      ->excludes(quiet)
      ->group(telling);
  CLI::Option* version = app.set_version_flag("--version", app.get_name() + " " + program_version())
                             ->description("Print the version and exit")
                             ->group(telling);
  add_json_flag(app, *version);
  app.set_help_flag("--help,-h", "Print this text and exit")->group(telling);
  add_choice(
      app, "--describe", kDescriptions,
      [&app](Describe describe) { throw CallForDescription(describe(facts_of(app))); },
      "Print a manual page or a completion")
      ->group("");
}

bool parse_command_line(CLI::App& app, int argc, const char* const* argv) {
  try {
    app.parse(argc, argv);
    return true;
  } catch (const CLI::CallForHelp&) {
    std::fputs(app.help().c_str(), stdout);
    return false;
  } catch (const CLI::CallForVersion& version) {
    std::fputs(version_text(app, version).c_str(), stdout);
    return false;
  } catch (const CallForDescription& description) {
    std::fputs(description.what(), stdout);
    return false;
  } catch (const CLI::RequiredError& error) {
    throw UsageError(message_of(app, error));
  } catch (const CLI::ArgumentMismatch& error) {
    throw UsageError(message_of(app, error));
  } catch (const CLI::ParseError& error) {
    throw UsageError(error.what());
  }
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
