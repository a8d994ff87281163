// SPDX-License-Identifier: MIT
#include "options/purposes.h"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

#include <spdlog/fmt/fmt.h>

#include "options/command_line.h"

namespace meshrepair {
namespace {

// What differs from the defaults.
struct Setting {
  std::string_view option;
  std::string_view value;
};

// A void that nobody sees, and what a generator left hollow, is to be full; crumbs do not print.
constexpr std::array kPrint = {Setting{"--seal", "double-walls"}, Setting{"--thicken", "auto"},
                               Setting{"--cavities", "fill"}, Setting{"--min-part", "1e-6"}};
// A void is part of a body that bears a load; crumbs make elements that are far too small.
constexpr std::array kSimulation = {Setting{"--min-part", "1e-6"}};
// What nobody sees goes, and what is seen stays where it is.
constexpr std::array kRender = {Setting{"--thicken", "auto"}, Setting{"--cavities", "fill"},
                                Setting{"--simplify", "0"}};
// An operand is to be what it was.
constexpr std::array kBoolean = {Setting{"--simplify", "0"}};

struct Bundle {
  std::string_view name;
  std::span<const Setting> settings;
};

constexpr std::array<Bundle, 4> kBundles = {
    {{"print", kPrint}, {"simulation", kSimulation}, {"render", kRender}, {"boolean", kBoolean}}};

std::string text_of(const Setting& setting) {
  return fmt::format("{} {}", setting.option, setting.value);
}

std::string help_text() {
  std::string text =
      "Set several options for a purpose; options on the command line take precedence:";
  for (const Bundle& bundle : kBundles) {
    std::vector<std::string> words;
    for (const Setting& setting : bundle.settings) words.push_back(text_of(setting));
    text += fmt::format("\n  {:<10}  {}", bundle.name, fmt::join(words, " "));
  }
  return text;
}

void apply(const Bundle& bundle, CommandLine& app, Purpose& purpose) {
  purpose.name = bundle.name;
  for (const Setting& setting : bundle.settings) {
    CommandOption& option = app.option(std::string(setting.option));
    if (option.count() > 0) {
      purpose.overridden.emplace_back(setting.option);
      continue;
    }
    option.add_result(std::string(setting.value));
    purpose.options.push_back(text_of(setting));
  }
}

}  // namespace

void add_purpose_option(CommandLine& app, Purpose& purpose) {
  std::vector<std::string> names;
  names.reserve(kBundles.size());
  for (const Bundle& bundle : kBundles) names.emplace_back(bundle.name);
  app.add_option_function(
         "--for",
         [&app, &purpose](const std::string& word) {
           apply(*std::find_if(kBundles.begin(), kBundles.end(),
                               [&](const Bundle& bundle) { return bundle.name == word; }),
                 app, purpose);
         },
         help_text())
      ->check(is_one_of(names))
      ->type_name("NAME")
      ->group("Repair");
}

}  // namespace meshrepair
