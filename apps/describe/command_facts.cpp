// SPDX-License-Identifier: MIT
#include "describe/command_facts.h"

#include <algorithm>
#include <sstream>
#include <string_view>

namespace meshrepair {
namespace {

std::vector<std::string> split(const std::string& text, char between) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, between);) parts.push_back(part);
  return parts;
}

std::string trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(' ') + 1 - first));
}

// "  auto      where it can be trusted", "  a number: so many".
TextBlock item_of(std::string_view line) {
  const std::size_t gap = line.find("  ", 2), colon = line.find(": ");
  const std::size_t end = std::min({gap, colon, line.size()});
  const std::size_t rest = std::min(line.size(), end + (end == colon ? 1 : 0));
  return {trimmed(line.substr(0, end)), trimmed(line.substr(rest))};
}

std::vector<TextBlock> blocks_of(const std::string& description) {
  std::vector<TextBlock> blocks;
  for (const std::string& line : split(description, '\n')) {
    const bool is_item = line.starts_with("  ") && !line.starts_with("   ");
    const bool continues_item = line.starts_with("   ") && !blocks.empty();
    const bool continues = !blocks.empty() && !is_item && blocks.back().tag.empty();
    if (is_item) {
      blocks.push_back(item_of(line));
    } else if (continues_item || continues) {
      blocks.back().text += " " + trimmed(line);
    } else {
      blocks.push_back({"", trimmed(line)});
    }
  }
  return blocks;
}

// "auto|none|X|X%": those in small letters are meant as they are.
void add_literal_words(const std::string& type, std::vector<std::string>& choices) {
  if (type.find('|') == std::string::npos) return;
  for (const std::string& word : split(type, '|')) {
    const bool is_literal = std::all_of(word.begin(), word.end(),
                                        [](char c) { return (c >= 'a' && c <= 'z') || c == '-'; });
    if (is_literal) choices.push_back(word);
  }
}

// The type of an option, and what each check is about: "NAME:{auto,none}", "FILE:.stl, .obj".
void read_type(const CommandOption& option, OptionFacts& facts) {
  const std::vector<std::string> parts = split(option.type(), ':');
  if (parts.empty()) return;
  facts.type = parts[0];
  facts.is_list = facts.type.ends_with(",...");
  facts.is_folder = facts.type == "FOLDER";
  facts.is_file = facts.type == "FILE";
  add_literal_words(facts.type, facts.choices);
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const std::string& about = parts[i];
    if (about.starts_with('{')) {
      facts.choices = split(about.substr(1, about.find('}') - 1), ',');
    } else if (about.starts_with('.')) {
      facts.is_file = true;
      for (const std::string& extension : split(about, ',')) {
        facts.extensions.push_back(trimmed(extension).substr(1));
      }
    }
  }
}

OptionFacts facts_of(const CommandOption& option) {
  OptionFacts facts;
  facts.is_argument = option.is_argument();
  facts.names = option.all_names();
  read_type(option, facts);
  if (facts.is_argument) facts.type.clear();
  facts.group = option.heading();
  facts.default_value = option.default_text();
  facts.description = blocks_of(option.description());
  facts.is_required = option.is_required();
  facts.is_repeated = option.is_repeated();
  return facts;
}

}  // namespace

std::string OptionFacts::headline() const {
  std::string text = description.empty() ? std::string() : description.front().text;
  text = text.substr(0, std::min({text.find(": "), text.find("; "), text.find(". "), text.size()}));
  while (text.ends_with(':') || text.ends_with('.')) text.pop_back();
  return text;
}

std::string OptionFacts::meaning_of(const std::string& choice) const {
  const auto found = std::find_if(description.begin(), description.end(),
                                  [&](const TextBlock& block) { return block.tag == choice; });
  return found == description.end() ? std::string() : found->text;
}

CommandFacts facts_of(const CommandLine& app) {
  CommandFacts command;
  command.name = app.name();
  command.description = app.description();
  for (const CommandOption* option : app.options()) {
    if (!option->heading().empty()) command.options.push_back(facts_of(*option));
  }
  std::stable_sort(
      command.options.begin(), command.options.end(),
      [](const OptionFacts& a, const OptionFacts& b) { return a.is_argument && !b.is_argument; });
  for (const std::string& line : split(app.footer(), '\n')) {
    if (line.starts_with("  ")) command.examples.push_back(trimmed(line));
  }
  return command;
}

}  // namespace meshrepair
