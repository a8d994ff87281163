// SPDX-License-Identifier: MIT
#include "resume/resumable.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

#include <base/error.h>
#include <mesh/packing.h>

#include "resume/state_folder.h"

namespace meshrepair {
namespace {

constexpr std::string_view kOutput = "OUT";

// How the program runs, and what it tells and draws. All others, also such as are not known yet,
// change results.
constexpr std::array<std::string_view, 26> kOthers = {
    "IN",         "--resume",        "--threads",      "--time-limit",     "--max-memory",
    "--temp",     "--max-triangles", "--progress-fd",  "--report",         "--explain",
    "--quiet",    "--verbose",       "--version",      "--json",           "--help",
    "--help-all", "--picture",       "--picture-size", "--picture-view",   "--picture-colours",
    "--show",     "--show-as",       "--html",         "--html-triangles", "--serve",
    "--jobs-from"};

template <class Names>
bool names(const Names& all, const std::string& name) {
  return std::find(all.begin(), all.end(), name) != all.end();
}

// Of the name of the output, what format it asks for.
std::string that_matters(const CommandOption& option, const std::string& value) {
  return option.name() == kOutput ? without_packing(value).extension().string() : value;
}

}  // namespace

bool changes_results(const CommandOption& option) { return !names(kOthers, option.name()); }

void add_resume_option(CommandLine& app, std::string& folder) {
  app.add_option("--resume", folder,
                 "Save progress in this folder, or continue from it after an interruption;\n"
                 "removed at the end")
      ->check([](const std::string& name) {
        return name.empty() ? std::string("needs the name of a folder") : std::string();
      })
      ->type_name("DIR")
      ->group("Running");
}

std::string options_of_results(const CommandLine& app, const std::vector<std::string>& others) {
  std::string all;
  for (const CommandOption* option : app.options()) {
    if (option->count() == 0 || !changes_results(*option)) continue;
    if (names(others, option->name())) continue;
    all += option->name();
    for (const std::string& value : option->results()) all += '=' + that_matters(*option, value);
    all += '\n';
  }
  return all;
}

void run_resumable(const std::string& folder, const CommandLine& app, Run& run,
                   const std::function<void(StateStore*)>& body) {
  if (folder.empty()) return body(nullptr);
  StateFolder states(folder, options_of_results(app, {}));
  try {
    body(&states);
  } catch (const NoSolidError&) {
    states.remove();
    throw;
  }
  states.remove();
  if (!states.loaded().empty()) run.report.set_section("resumed", {{"from", states.loaded()}});
}

}  // namespace meshrepair
