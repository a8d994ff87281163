// SPDX-License-Identifier: MIT
#include "program/command_files.h"

#include <filesystem>
#include <system_error>

#include <base/atomic_file.h>
#include <base/error.h>

namespace meshrepair {
namespace {

namespace fs = std::filesystem;

// Where a path leads, also where nothing is yet.
fs::path place_of(const fs::path& path) {
  std::error_code error;
  return fs::weakly_canonical(fs::absolute(follow_links(path), error), error);
}

// `named`: which of both names the message has.
void check_report(Run& run, const std::string& file, const std::string& named,
                  const std::string& what) {
  if (run.options.report.empty() || !is_same_file(run.options.report, file)) return;
  run.report.withhold();
  throw UsageError("--report: " + named + " is the " + what + ", too");
}

}  // namespace

bool is_same_file(const std::string& a, const std::string& b) {
  if (a == "-" || b == "-") return a == b;
  std::error_code error;
  if (fs::is_character_file(a, error)) return false;
  if (fs::exists(a, error) && fs::exists(b, error)) return fs::equivalent(a, b, error);
  return place_of(a) == place_of(b);
}

void check_files(const std::string& input, const std::string& output, Run& run) {
  if (input.empty()) throw UsageError("the name of the input is empty");
  if (input != "-") check_report(run, input, run.options.report, "input");
  if (output.empty()) return;
  check_report(run, output, run.options.report, "output");
  if (output != "-") check_folder(output);
}

void check_inputs(const std::vector<std::string>& inputs) {
  for (const std::string& input : inputs) {
    std::error_code error;
    if (input == "-" || fs::status(input, error).type() != fs::file_type::not_found) continue;
    throw InputError(input + ": cannot be opened: " + error.default_error_condition().message());
  }
}

void check_folder(const std::string& file) {
  const fs::path folder = fs::path(file).parent_path();
  std::error_code error;
  if (!folder.empty() && !fs::is_directory(folder, error)) {
    throw OutputError(file + ": there is no folder " + folder.string());
  }
  if (fs::is_directory(file, error)) throw OutputError(file + ": is a folder");
}

std::string lower_extension(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension;
}

void check_side_file(const SideFile& file, const std::vector<std::string>& others, Run& run) {
  check_report(run, file.path, file.path, file.what);
  for (const std::string& other : others) {
    if (other.empty() || !is_same_file(file.path, other)) continue;
    throw UsageError(file.option + ": " + file.path + " is another file of this command, too");
  }
  check_folder(file.path);
}

}  // namespace meshrepair
