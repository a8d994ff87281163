// SPDX-License-Identifier: MIT
#include "calls/session.h"

#include <algorithm>
#include <exception>
#include <new>
#include <optional>

#include <base/error.h>
#include <base/parallel.h>

#include "calls/plain_locale.h"
#include "options/command_line.h"
#include "options/removed_options.h"
#include "process/memory_limit.h"
#include "terminal/warning_log.h"

namespace meshrepair {
namespace {

// Those of the programs that are about their process, or about what they print.
constexpr std::string_view kOfPrograms[] = {"report", "quiet",    "verbose",     "version", "help",
                                            "json",   "describe", "progress-fd", "temp"};

template <class Names>
bool is_among(const Names& names, std::string_view name) {
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

// As the programs have it.
std::string option_name(std::string name) {
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

// The word of the command line; empty where it has none.
std::string word_of(const CommandOption& option, const Keyword& keyword) {
  const auto& [name, value] = keyword;
  const bool is_flag = option.is_flag();
  if (const bool* set = std::get_if<bool>(&value)) {
    if (!is_flag) throw UsageError(name + ": needs a value");
    return *set ? "--" + option_name(name) : std::string();
  }
  if (is_flag) throw UsageError(name + ": is a flag, and takes no value");
  return "--" + option_name(name) + "=" + std::get<std::string>(value);
}

}  // namespace

Session::Session(const std::string& program) : app_("", program), command_({program}) {
  common_.max_memory = "0";  // the process is the caller's
  add_common_options(app_, common_);
}

void Session::parse(const Keywords& keywords, const std::vector<std::string_view>& refused) {
  const PlainLocale plain;
  for (const Keyword& keyword : keywords) {
    const std::string name = option_name(keyword.first);
    const CommandOption* const option = app_.find("--" + name);
    const std::string why = why_removed(app_, "--" + name, Spelling::keywords);
    if (!why.empty()) throw UsageError(keyword.first + ": " + why);
    if (option == nullptr || is_among(kOfPrograms, name)) {
      throw UsageError(keyword.first + ": there is no such option");
    }
    if (is_among(refused, name)) {
      throw UsageError(keyword.first + ": is for files, and here are none");
    }
    if (std::string word = word_of(*option, keyword); !word.empty()) command_.push_back(word);
  }
  (void)app_.parse(std::vector<std::string>(command_.begin() + 1, command_.end()));
  common_.quiet = true;
}

ProgressBar::Options Session::limits() const {
  ProgressBar::Options limits;
  limits.time_limit = common_.time_limit;
  limits.memory_limit = parse_memory_limit(common_.max_memory).bytes;
  return limits;
}

Outcome Session::run(CallProgress& progress, const Body& body) const {
  Outcome outcome;
  const WarningLog warnings;
  JsonReport report(command_.front(), command_);
  std::exception_ptr error;
  try {
    const ThreadLimit thread_limit(common_.threads);
    Run run{report, progress, common_};
    outcome.code = body(run);
  } catch (const std::bad_alloc&) {
    error = std::make_exception_ptr(LimitError(progress.out_of_memory()));
  } catch (const OutOfThreads&) {
    error = std::make_exception_ptr(progress.out_of_threads());
  } catch (...) {
    error = std::current_exception();
  }
  for (const ToldWarning& told : warnings.told()) outcome.warnings.push_back(text_of(told));
  report.set_warnings(warnings.told());
  progress.finish();
  std::optional<Failure> failure;
  if (error) failure = describe_failure(error);
  if (failure) outcome.code = failure->code;
  outcome.error = failure ? failure->message : report.error().value_or("");
  outcome.report = report.text(outcome.code, failure, progress);
  return outcome;
}

}  // namespace meshrepair
