// SPDX-License-Identifier: MIT
// Names of options end where they are whole words, so -S adds nothing; lists of names go on behind
// their last comma. _init_completion splits --option=value, and _filedir offers folders as well.
#include <spdlog/fmt/fmt.h>

#include "describe/completions.h"

namespace meshrepair {
namespace {

std::string joined(const std::vector<std::string>& words, std::string_view between) {
  return fmt::format("{}", fmt::join(words, between));
}

std::string bash_files(const OptionFacts& option) {
  if (option.is_folder) return "_filedir -d";
  if (option.extensions.empty()) return "_filedir";
  return "_filedir '@(" + joined(option.extensions, "|") + ")'";
}

std::string bash_words(const OptionFacts& option) {
  const std::string list = joined(option.choices, " ");
  if (!option.is_list) return fmt::format("COMPREPLY=($(compgen -W '{}' -- \"$cur\"))", list);
  return fmt::format(
      "[[ $cur == *,* ]] && before=${{cur%,*}},\n"
      "      COMPREPLY=($(compgen -P \"$before\" -W '{}' -- \"${{cur##*,}}\"))",
      list);
}

// What completes the value; ":" where nobody can guess it.
std::string bash_value(const OptionFacts& option) {
  if (!option.choices.empty()) return bash_words(option);
  return option.is_file || option.is_folder ? bash_files(option) : ":";
}

}  // namespace

std::string bash_completion(const CommandFacts& command) {
  std::vector<std::string> names;
  std::string cases;
  std::string arguments = "_filedir";
  for (const OptionFacts& option : command.options) {
    if (option.is_argument) {
      if (arguments == "_filedir") arguments = bash_files(option);
      continue;
    }
    names.insert(names.end(), option.names.begin(), option.names.end());
    if (option.type.empty()) continue;
    cases += fmt::format("    {})\n      {}\n      return\n      ;;\n", joined(option.names, " | "),
                         bash_value(option));
  }
  return fmt::format(
      "# Completes command lines of {0}. Made of its options: {0} --describe bash\n"
      "_{0}() {{\n"
      "  local cur prev words cword split before=\n"
      "  _init_completion -s || return\n"
      "  case $prev in\n"
      "{1}"
      "  esac\n"
      "  $split && return\n"
      "  if [[ $cur == -* ]]; then\n"
      "    COMPREPLY=($(compgen -W '{2}' -- \"$cur\"))\n"
      "  else\n"
      "    {3}\n"
      "  fi\n"
      "}} &&\n"
      "  complete -F _{0} {0}\n",
      command.name, cases, joined(names, " "), arguments);
}

}  // namespace meshrepair
