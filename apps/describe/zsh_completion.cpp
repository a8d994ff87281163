// SPDX-License-Identifier: MIT
#include <spdlog/fmt/fmt.h>

#include "describe/completions.h"

namespace meshrepair {
namespace {

// Of a word within single quotes in a specification of _arguments.
std::string zsh_in_quotes(const std::string& text, std::string_view special) {
  std::string result;
  for (const char c : text) {
    if (c == '\'') {
      result += "'\\''";
      continue;
    }
    if (special.find(c) != std::string_view::npos) result += '\\';
    result += c;
  }
  return result;
}

std::string zsh_files(const OptionFacts& option) {
  if (option.is_folder) return "_files -/";
  if (option.extensions.empty()) return "_files";
  // One name in parentheses would be taken for qualifiers.
  if (option.extensions.size() == 1) {
    return fmt::format("_files -g \"(#i)*.{}\"", option.extensions.front());
  }
  return fmt::format("_files -g \"(#i)*.({})\"", fmt::join(option.extensions, "|"));
}

std::string zsh_choices(const OptionFacts& option) {
  std::vector<std::string> list;
  for (const std::string& choice : option.choices) {
    const std::string meaning = option.meaning_of(choice);
    list.push_back(choice);
    if (option.is_list || meaning.empty()) continue;
    list.back() +=
        "\\:" + zsh_in_quotes(fmt::format("\"{}\"", zsh_in_quotes(meaning, "\"\\$`")), ":");
  }
  if (!option.is_list) return fmt::format("(({}))", fmt::join(list, " "));
  const std::string what = option.type.substr(0, option.type.find(','));
  return fmt::format("_values -s , {} {}", what, fmt::join(list, " "));
}

// What completes the value: a message and an action.
std::string zsh_value(const OptionFacts& option, const std::string& what) {
  std::string action = " ";
  if (option.is_file || option.is_folder) action = zsh_files(option);
  if (!option.choices.empty()) action = zsh_choices(option);
  return fmt::format(":{}:{}", zsh_in_quotes(what, ":"), action);
}

std::string zsh_spec_of(const OptionFacts& option) {
  const std::string about = fmt::format("[{}]", zsh_in_quotes(option.headline(), "[]\\"));
  if (option.is_argument) {
    return fmt::format("'{}{}'", option.is_repeated ? "*" : "", zsh_value(option, option.name()));
  }
  const std::string end = option.type.empty() ? "" : zsh_value(option, option.type);
  if (option.names.size() == 1) {
    return fmt::format("'{}{}{}{}'", option.name(), option.type.empty() ? "" : "=", about, end);
  }
  std::vector<std::string> names;
  for (const std::string& name : option.names) {
    const bool takes_equals = !option.type.empty() && name.starts_with("--");
    names.push_back(name + (takes_equals ? "=" : ""));
  }
  return fmt::format("'({})'{{{}}}'{}{}'", fmt::join(option.names, " "), fmt::join(names, ","),
                     about, end);
}

}  // namespace

std::string zsh_completion(const CommandFacts& command) {
  std::string specs;
  for (const OptionFacts& option : command.options) specs += " \\\n  " + zsh_spec_of(option);
  return fmt::format(
      "#compdef {0}\n"
      "# Completes command lines of {0}. Made of its options: {0} --describe zsh\n"
      "_arguments -s -S{1}\n",
      command.name, specs);
}

}  // namespace meshrepair
