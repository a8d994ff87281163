// SPDX-License-Identifier: MIT
#include <spdlog/fmt/fmt.h>

#include "describe/completions.h"

namespace meshrepair {
namespace {

// Within single quotes.
std::string fish_in_quotes(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') result += '\\';
    result += c;
  }
  return result + "'";
}

std::string fish_files(const CommandFacts& command, const OptionFacts& option) {
  if (option.is_folder) return fish_in_quotes("(__fish_complete_directories)");
  return fish_in_quotes(
      fmt::format("(__{}_files {})", command.name, fmt::join(option.extensions, " ")));
}

// Names, each with its meaning behind a tab; fish reads the words once more.
std::string fish_choices(const OptionFacts& option) {
  std::vector<std::string> list = option.choices;
  if (option.is_list) {
    return fish_in_quotes(fmt::format("(__fish_append , {})", fmt::join(list, " ")));
  }
  for (std::string& choice : list) {
    const std::string meaning = option.meaning_of(choice);
    if (!meaning.empty()) choice += "\\t" + fish_in_quotes(meaning);
  }
  return fish_in_quotes(fmt::format("{}", fmt::join(list, " ")));
}

std::string fish_value(const CommandFacts& command, const OptionFacts& option) {
  if (option.type.empty()) return {};
  if (!option.choices.empty()) return " -x -a " + fish_choices(option);
  if (option.is_folder || !option.extensions.empty())
    return " -x -a " + fish_files(command, option);
  return option.is_file ? " -r -F" : " -x";
}

std::string fish_line_of(const CommandFacts& command, const OptionFacts& option) {
  std::string line = "complete -c " + command.name;
  for (const std::string& name : option.names) {
    line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  }
  return line + fish_value(command, option) + " -d " + fish_in_quotes(option.headline()) + "\n";
}

}  // namespace

std::string fish_completion(const CommandFacts& command) {
  std::string text = fmt::format(
      "# Completes command lines of {0}. Made of its options: {0} --describe fish\n"
      "function __{0}_files\n"
      "  set -l word (commandline -ct | string replace -r -- '^--[^=]*=' '')\n"
      "  set -l ends (string join '|' -- $argv)\n"
      "  complete -C \"__fish_command_without_completions $word\" |\n"
      "    string match -r -i -e -- \"(?:/|\\\\.(?:$ends))(?:\\t|\\$)\"\n"
      "end\n"
      "complete -c {0} -f\n",
      command.name);
  for (const OptionFacts& option : command.options) {
    if (!option.is_argument) {
      text += fish_line_of(command, option);
    } else {
      text += fmt::format("complete -c {} {} -d {}\n", command.name,
                          option.extensions.empty() ? "-F" : "-a " + fish_files(command, option),
                          fish_in_quotes(option.name()));
    }
  }
  return text;
}

}  // namespace meshrepair
