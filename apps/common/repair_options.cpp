#include "common/repair_options.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/Validators.hpp>

namespace meshrepair {
namespace {

template <class Value>
using Choice = std::pair<std::string_view, Value>;

constexpr std::array<Choice<InsideRule>, 4> kRules = {{{"auto", InsideRule::automatic},
                                                       {"solidity", InsideRule::solidity},
                                                       {"parity", InsideRule::parity},
                                                       {"winding", InsideRule::winding}}};

constexpr std::array<Choice<Cavities>, 2> kCavities = {
    {{"keep", Cavities::keep}, {"fill", Cavities::fill}}};

constexpr std::array<Choice<SoupFormat>, 6> kFormats = {{{"stl", SoupFormat::stl_binary},
                                                         {"stl-ascii", SoupFormat::stl_ascii},
                                                         {"obj", SoupFormat::obj},
                                                         {"off", SoupFormat::off},
                                                         {"ply", SoupFormat::ply_binary},
                                                         {"ply-ascii", SoupFormat::ply_ascii}}};

constexpr std::array<Choice<Precision>, 2> kPrecisions = {
    {{"float64", Precision::float64}, {"float32", Precision::float32}}};

// An option whose value is one of the names. `set` gets the value of the name.
template <class Choices, class Set>
CLI::Option* add_choice(CLI::App& app, const std::string& name, const Choices& choices, Set set,
                        const std::string& description) {
  std::vector<std::string> names;
  names.reserve(choices.size());
  for (const auto& choice : choices) names.emplace_back(choice.first);
  return app
      .add_option_function<std::string>(
          name,
          [&choices, set](const std::string& word) {
            set(std::find_if(choices.begin(), choices.end(), [&](const auto& choice) {
                  return choice.first == word;
                })->second);
          },
          description)
      ->check(CLI::IsMember(names))
      ->type_name("NAME");
}

}  // namespace

void add_inside_options(CLI::App& app, InsideOptions& inside) {
  add_choice(
      app, "--inside", kRules, [&inside](InsideRule value) { inside.rule = value; },
      "How to decide what is solid:\n"
      "  auto      winding where the orientation can be trusted, else solidity\n"
      "  solidity  looks at no orientation; fills voids\n"
      "  parity    looks at no orientation; voids and overlaps are empty\n"
      "  winding   trusts the orientation; overlaps are solid, voids empty\n")
      ->default_str(std::string(rule_name(inside.rule)))
      ->group("Repair");
  add_choice(
      app, "--cavities", kCavities, [&inside](Cavities value) { inside.cavities = value; },
      "What becomes of voids that no way leads into from outside:\n"
      "  keep  as the rule of --inside says\n"
      "  fill  solid, whatever the rule\n")
      ->default_str("keep")
      ->group("Repair");
}

void add_output_option(CLI::App& app, std::string& output, const std::string& type,
                       const std::string& description) {
  app.add_option("-o,--output", output, description)->required()->type_name(type)->group("Output");
}

void add_format_option(CLI::App& app, std::optional<SoupFormat>& format) {
  add_choice(
      app, "--format", kFormats, [&format](SoupFormat value) { format = value; },
      "Format of OUT: stl, stl-ascii, obj, off, ply, ply-ascii")
      ->default_str("by the name of OUT")
      ->group("Output");
}

void add_certify_options(CLI::App& app, CertifyOptions& certify, bool& strict) {
  add_choice(
      app, "--precision", kPrecisions, [&certify](Precision value) { certify.precision = value; },
      "Round the coordinates of OUT to this, and certify them so: float64, float32;\n"
      "binary STL is always float32")
      ->default_str("float64")
      ->group("Output");
  app.add_flag("--strict", strict, "Write nothing when the result cannot be certified")
      ->group("Output");
}

void add_check_cells_option(CLI::App& app, bool& check_cells) {
  app.add_flag("--check-cells", check_cells,
               "Debugging: prove the cells' invariants after each cut; slow")
      ->group("Repair");
}

}  // namespace meshrepair
