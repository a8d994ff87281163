// SPDX-License-Identifier: MIT
// An option of the command line whose value is one of a few names.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "options/command_line.h"

namespace meshrepair {

template <class Value>
using Choice = std::pair<std::string_view, Value>;

// `choices`, a range of Choice, must outlive the app. `set` gets the value of the name.
template <class Choices, class Set>
CommandOption* add_choice(CommandLine& app, const std::string& name, const Choices& choices,
                          Set set, const std::string& description) {
  std::vector<std::string> names;
  names.reserve(choices.size());
  for (const auto& choice : choices) names.emplace_back(choice.first);
  return app
      .add_option_function(
          name,
          [&choices, set](const std::string& word) {
            set(std::find_if(choices.begin(), choices.end(), [&](const auto& choice) {
                  return choice.first == word;
                })->second);
          },
          description)
      ->check(is_one_of(names))
      ->type_name("NAME");
}

}  // namespace meshrepair
