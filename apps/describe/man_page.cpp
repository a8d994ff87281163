// SPDX-License-Identifier: MIT
#include "describe/man_page.h"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <vector>

#include <spdlog/fmt/fmt.h>

#include "process/exit_code.h"
#include "report/json_report.h"

namespace meshrepair {
namespace {

// A backslash and a minus mean something else to man; so do a full stop and a quote at the
// beginning of a line.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else {
      result += c;
    }
  }
  const bool is_request = result.starts_with('.') || result.starts_with('\'');
  return is_request ? "\\&" + result : result;
}

std::string bold(const std::string& text) { return "\\fB" + escaped(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + escaped(text) + "\\fR"; }

std::string in_capitals(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](char c) {
    return static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  });
  return text;
}

class Page {
 public:
  explicit Page(const CommandFacts& command) : command_(command) {}

  std::string text() {
    line(fmt::format(".TH {} 1 \"\" \"meshrepair {}\" \"User Commands\"",
                     in_capitals(command_.name), program_version()));
    line(".SH NAME");
    std::string what = command_.description;
    while (what.ends_with('.')) what.pop_back();
    line(escaped(command_.name) + " \\- " + escaped(what));
    synopsis();
    line(".SH DESCRIPTION");
    line(escaped(command_.description));
    arguments();
    options();
    exit_status();
    examples();
    see_also();
    return page_;
  }

 private:
  void line(const std::string& text) { page_ += text + '\n'; }

  void synopsis() {
    line(".SH SYNOPSIS");
    std::vector<std::string> words = {bold(command_.name), fmt::format("[{}]", italic("OPTIONS"))};
    for (const OptionFacts& option : command_.options) {
      if (option.is_argument) {
        words.push_back(italic(option.name()) + (option.is_repeated ? "..." : ""));
      } else if (option.is_required) {
        words.push_back(bold(option.name()) + " " + italic(option.type));
      }
    }
    line(fmt::format("{}", fmt::join(words, " ")));
  }

  void arguments() {
    for (const OptionFacts& option : command_.options) {
      if (!option.is_argument) continue;
      line(fmt::format(".TP\n{}", italic(option.name())));
      describe(option);
    }
  }

  void options() {
    line(".SH OPTIONS");
    std::string group;
    for (const OptionFacts& option : command_.options) {
      if (option.is_argument) continue;
      if (option.group != group) line(".SS " + option.group);
      group = option.group;
      std::vector<std::string> names;
      for (const std::string& name : option.names) names.push_back(bold(name));
      if (!option.type.empty()) names.back() += fmt::format(" {}", italic(option.type));
      line(fmt::format(".TP\n{}", fmt::join(names, ", ")));
      describe(option);
    }
  }

  void describe(const OptionFacts& option) {
    bool in_list = false;
    for (const TextBlock& block : option.description) {
      if (block.tag.empty() && in_list) line(".RE\n.IP");
      if (!block.tag.empty() && !in_list) line(".RS");
      in_list = !block.tag.empty();
      if (in_list) line(fmt::format(".TP\n{}", bold(block.tag)));
      line(escaped(block.text.empty() ? block.tag : block.text));
    }
    if (in_list) line(".RE");
    if (option.default_value.empty()) return;
    if (in_list) line(".IP");
    line(escaped("(default: " + option.default_value + ")"));
  }

  void exit_status() {
    line(".SH EXIT STATUS");
    for (const auto& [code, meaning] : kExitCodes) {
      line(fmt::format(".TP\n{}\n{}", bold(std::to_string(static_cast<int>(code))),
                       escaped(std::string(meaning))));
    }
  }

  void examples() {
    line(".SH EXAMPLES\n.EX");
    for (const std::string& example : command_.examples) line(escaped(example));
    line(".EE");
  }

  void see_also() {
    std::vector<std::string> others;
    std::istringstream programs(MESHREPAIR_PROGRAMS);
    for (std::string program; programs >> program;) {
      if (program != command_.name) others.push_back(bold(program) + "(1)");
    }
    line(fmt::format(".SH SEE ALSO\n{}", fmt::join(others, ", ")));
  }

  const CommandFacts& command_;
  std::string page_;
};

}  // namespace

std::string man_page(const CommandFacts& command) { return Page(command).text(); }

}  // namespace meshrepair
