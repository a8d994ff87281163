// SPDX-License-Identifier: MIT
// What the options of a program say of themselves, apart from CLI11: manual pages and completions
// are made of it, so that they say the same as --help.
#pragma once

#include <string>
#include <vector>

#include "options/command_line.h"

namespace meshrepair {

// A paragraph, or an item of a list: "auto  where it can be trusted".
struct TextBlock {
  std::string tag;  // empty: a paragraph
  std::string text;
};

struct OptionFacts {
  std::vector<std::string> names;  // "-q", "--quiet"; of an argument its only one
  std::string type;                // of the value: "N"; empty: a flag has none
  std::vector<std::string> choices;
  bool is_list = false;  // of several choices, with commas between
  bool is_file = false, is_folder = false;
  std::vector<std::string> extensions;  // of a file: "stl"; empty: any
  std::string group;
  std::string default_value;
  std::vector<TextBlock> description;
  bool is_argument = false;  // without a name on the command line
  bool is_required = false;
  bool is_repeated = false;  // an argument that stands for several

  // The name to be told by: without short forms.
  [[nodiscard]] const std::string& name() const { return names.back(); }
  // The first sentence, without a full stop.
  [[nodiscard]] std::string headline() const;
  // What the description says of a choice; empty: nothing.
  [[nodiscard]] std::string meaning_of(const std::string& choice) const;
};

struct CommandFacts {
  std::string name;
  std::string description;
  std::vector<OptionFacts> options;  // as --help shows them, arguments first
  std::vector<std::string> examples;
};

[[nodiscard]] CommandFacts facts_of(const CommandLine& app);

}  // namespace meshrepair
