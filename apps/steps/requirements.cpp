// SPDX-License-Identifier: MIT
#include "steps/requirements.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include <spdlog/fmt/fmt.h>

#include <base/error.h>
#include <base/file_bytes.h>

#include "options/numbers.h"
#include "report/json.h"
#include "report/report_sections.h"
#include "report/words.h"
#include "terminal/warning_log.h"

namespace meshrepair {
namespace {

using Relation = Requirement::Relation;
using BoundKind = Requirement::Kind;

// A short name. `before`: the same of the input, or what the number is a share of; may be empty.
struct Key {
  std::string_view name, path, before;
  bool is_share = false;
};

constexpr std::array kKeys = std::to_array<Key>({
    {"parts", "result.parts", "defects.parts"},
    {"triangles", "result.triangles", "clean.triangles_in"},
    {"volume", "result.volume", "defects.volume"},
    {"area", "result.area", "defects.area"},
    {"lost-area", "removed.lost_area", "defects.area", true},
    {"made-up", "result.closing_area", "result.area", true},
    {"moved", "distance.kept_to_output.hausdorff", "distance.diagonal", true},
    {"distance", "distance.output_to_input.hausdorff", "distance.diagonal", true},
    {"holes", "holes.closed", ""},
    {"warnings", "", ""},
});

const Key* find_key(std::string_view name) {
  const auto* const found =
      std::find_if(kKeys.begin(), kKeys.end(), [&](const Key& key) { return key.name == name; });
  return found == kKeys.end() ? nullptr : found;
}

bool is_code(std::string_view name) {
  const auto kinds = warning_kinds();
  return std::any_of(kinds.begin(), kinds.end(),
                     [&](const WarningKind& kind) { return kind.code == name; });
}

std::string trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\n\r");
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(" \t\n\r") - first + 1));
}

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
  throw UsageError("--require: " + text + ": " + why);
}

std::string all_names() {
  std::string names;
  for (const Key& key : kKeys) names += std::string(key.name) + ", ";
  return names;
}

void check_key(const Requirement& one) {
  const Key* const key = find_key(one.key);
  if (key == nullptr && !is_code(one.key) && one.key.find('.') == std::string::npos) {
    refuse(one.text, "'" + one.key + "' is none of " + all_names() +
                         "the code of a warning, or a key of the report such as result.parts");
  }
  if (one.kind == BoundKind::number) return;
  const bool has_before = key != nullptr && !key->before.empty();
  if (!has_before) refuse(one.text, "takes a number alone");
  if (key->is_share && one.kind != BoundKind::percent)
    refuse(one.text, "takes a number or a percentage");
  if (!key->is_share && one.kind == BoundKind::percent && one.relation == Relation::at_least)
    refuse(one.text,
           "a change can only be at most so large; a ratio, such as 0.9x, is a bound below");
}

// "1%", "1.5x", "same", "3".
void parse_bound(std::string word, Requirement& one) {
  if (word == "same") {
    if (one.relation != Relation::equal) refuse(one.text, "'same' needs =");
    one.kind = BoundKind::same;
    one.bound = 1;
    return;
  }
  const char unit = word.empty() ? '\0' : word.back();
  if (unit == '%') one.kind = BoundKind::percent;
  if (unit == 'x') one.kind = BoundKind::ratio;
  if (one.kind != BoundKind::number) word.pop_back();
  const std::optional<double> number = parse_number(trimmed(word));
  const bool may_be_negative = one.kind == BoundKind::number;
  if (!number || !std::isfinite(*number) || (*number < 0 && !may_be_negative)) {
    refuse(one.text,
           "the bound is no number, percentage such as 1%, ratio such as 1.5x, or 'same'");
  }
  one.bound = one.kind == BoundKind::percent ? *number / 100 : *number;
}

}  // namespace

Requirement parse_requirement(const std::string& text) {
  Requirement one;
  one.text = trimmed(text);
  const std::size_t at = one.text.find_first_of("<>=");
  if (at == std::string::npos)
    refuse(one.text, "is no condition such as parts=same, and no file NAME.json");
  one.key = trimmed(std::string_view(one.text).substr(0, at));
  std::size_t end = at + 1;
  if (one.text[at] != '=') {
    if (end == one.text.size() || one.text[end] != '=') refuse(one.text, "use <=, >= or =");
    one.relation = one.text[at] == '<' ? Relation::at_most : Relation::at_least;
    ++end;
  }
  parse_bound(trimmed(std::string_view(one.text).substr(end)), one);
  check_key(one);
  return one;
}

namespace {

constexpr std::size_t kMostPolicyBytes = std::size_t{1} << 20;

// "1%" and 3 are what a number has to be, "<=3" says it itself.
std::string condition_of(const std::string& key, const Json& value, const std::string& file) {
  std::string bound;
  if (const std::optional<std::string> text = value.as_text()) bound = trimmed(*text);
  if (value.as_number()) bound = value.dump();
  if (bound.empty()) throw UsageError("--require: " + file + ": " + key + " has no bound");
  return key + (std::string_view("<>=").find(bound.front()) == std::string_view::npos ? "=" : "") +
         bound;
}

std::vector<std::string> conditions_in(const std::string& file) {
  std::string bytes;
  try {
    bytes = std::string(FileBytes(file).bytes().substr(0, kMostPolicyBytes + 1));
  } catch (const InputError& error) {
    throw UsageError(std::string("--require: ") + error.what());
  }
  const std::optional<Json> policy = Json::parse(bytes);
  if (bytes.size() > kMostPolicyBytes || !policy || !(policy->is_object() || policy->is_array())) {
    throw UsageError("--require: " + file +
                     " is no JSON object of conditions such as {\"parts\": \"same\"}");
  }
  std::vector<std::string> conditions;
  if (policy->is_array()) {
    for (const Json& one : policy->values()) {
      if (!one.as_text()) throw UsageError("--require: " + file + ": a condition is no text");
      conditions.push_back(*one.as_text());
    }
    return conditions;
  }
  for (const auto& [key, value] : policy->items()) {
    if (!value.is_array()) {
      conditions.push_back(condition_of(key, value, file));
      continue;
    }
    for (const Json& one : value.values()) conditions.push_back(condition_of(key, one, file));
  }
  return conditions;
}

std::vector<std::string> conditions_of(const std::string& word) {
  if (word.ends_with(".json")) return conditions_in(word);
  std::vector<std::string> conditions;
  for (std::size_t start = 0; start <= word.size();) {
    const std::size_t comma = std::min(word.find(',', start), word.size());
    std::string one = trimmed(std::string_view(word).substr(start, comma - start));
    if (!one.empty() || word.empty()) conditions.push_back(std::move(one));
    start = comma + 1;
  }
  return conditions;
}

}  // namespace

void add_require_option(CommandLine& app, std::vector<Requirement>& requirements) {
  app.add_option_function(
         "--require",
         [&requirements](const std::string& word) {
           requirements.clear();
           for (const std::string& text : conditions_of(word)) {
             requirements.push_back(parse_requirement(text));
           }
         },
         "Require conditions of the result, with commas between, or those in a JSON file: exit\n"
         "code 1 if one is not met, and with --strict OUT is not written. A condition is a key,\n"
         "=, <= or >=, and a bound: a number, 'same' as in IN, 1% of a change or share, 1.5x IN.\n"
         "Keys: parts, triangles, volume, area, lost-area, made-up, moved, distance, holes,\n"
         "warnings, a code such as W-AREA-LOST, and any number of the report")
      ->type_name("TEXT|FILE")
      ->group("Output");
}

bool asks_for_distance(const std::vector<Requirement>& requirements) {
  return std::any_of(requirements.begin(), requirements.end(), [](const Requirement& one) {
    const Key* const key = find_key(one.key);
    return (key != nullptr ? key->path : std::string_view(one.key)).starts_with("distance.");
  });
}

namespace {

// The numbers of a run, as reports have them.
class Facts {
 public:
  explicit Facts(const Findings& findings) {
    JsonReport report("", {});
    add_sections(findings, report);
    sections_ = report.take_sections();
  }

  [[nodiscard]] std::optional<double> value_of(const Requirement& one) const {
    if (one.key == "warnings") return static_cast<double>(told_.size());
    if (is_code(one.key)) {
      return static_cast<double>(std::count_if(
          told_.begin(), told_.end(),
          [&](const ToldWarning& told) { return kind_of(told.warning.code).code == one.key; }));
    }
    if (one.key == "moved") return farthest_move();
    const Key* const key = find_key(one.key);
    const std::optional<double> found = at(key == nullptr ? std::string_view(one.key) : key->path);
    return found || key == nullptr || !may_be_missing(key->path) ? found : 0;
  }

  [[nodiscard]] std::optional<double> before(const Requirement& one) const {
    const Key* const key = find_key(one.key);
    if (key == nullptr || key->before.empty()) return std::nullopt;
    return at(key->before);
  }

 private:
  // There is no such section where nothing had to be done.
  static bool may_be_missing(std::string_view path) {
    return path.starts_with("holes.") || path.starts_with("removed.");
  }

  // Of triangles that are there whole, and of what was joined, sewn or simplified.
  [[nodiscard]] std::optional<double> farthest_move() const {
    std::optional<double> farthest = at("distance.kept_to_output.hausdorff");
    if (!farthest) return farthest;
    for (const std::string_view path :
         {"sew.farthest_move", "join_gaps.farthest_move", "simplify.distance_at_most"}) {
      farthest = std::max(*farthest, at(path).value_or(0));
    }
    return farthest;
  }

  [[nodiscard]] std::optional<double> at(std::string_view path) const {
    const Json* node = &sections_;
    while (node != nullptr && !path.empty()) {
      const std::size_t dot = std::min(path.find('.'), path.size());
      node = node->find(path.substr(0, dot));
      path.remove_prefix(std::min(dot + 1, path.size()));
    }
    if (node == nullptr) return std::nullopt;
    if (const std::optional<bool> flag = node->as_bool()) return *flag ? 1 : 0;
    return node->as_number();
  }

  Json sections_;
  std::vector<ToldWarning> told_ = told_warnings();
};

// What is compared with the bound.
std::optional<double> measured(const Requirement& one, double value, std::optional<double> before) {
  if (one.kind == BoundKind::number) return value;
  if (!before) return std::nullopt;
  const Key* const key = find_key(one.key);
  // A mesh may have been inside out.
  const double from = std::abs(*before), now = std::abs(value);
  if (from == 0) {
    if (now == 0) return one.kind == BoundKind::percent ? 0 : 1;
    return std::nullopt;
  }
  if (one.kind != BoundKind::percent) return now / from;
  return key->is_share ? now / from : std::abs(now - from) / from;
}

bool holds(const Requirement& one, double measure) {
  const bool is_change = one.kind == BoundKind::percent && one.relation == Relation::equal;
  if (one.relation == Relation::at_most || is_change) return measure <= one.bound;
  return one.relation == Relation::at_least ? measure >= one.bound : measure == one.bound;
}

std::string words_on(const Requirement& one, std::optional<double> value,
                     std::optional<double> before, std::optional<double> measure) {
  if (!value) return one.text + " is not met: unknown";
  std::string text = fmt::format("{} is not met: {:.6g}", one.text, *value);
  if (before && !find_key(one.key)->is_share) text += fmt::format(", before {:.6g}", *before);
  if (measure && one.kind == BoundKind::percent) text += fmt::format(" ({:.3g} %)", 100 * *measure);
  if (measure && one.kind == BoundKind::ratio) text += fmt::format(" ({:.4g}x)", *measure);
  return text;
}

Json json_or_null(std::optional<double> value) { return value ? Json(*value) : Json(); }

}  // namespace

void judge_requirements(const std::vector<Requirement>& requirements, Findings& findings) {
  if (requirements.empty()) return;
  const Facts facts(findings);
  findings.required = Json::array();
  for (const Requirement& one : requirements) {
    const std::optional<double> value = facts.value_of(one), before = facts.before(one);
    const std::optional<double> measure = value ? measured(one, *value, before) : std::nullopt;
    const bool is_met = measure && holds(one, *measure);
    if (!is_met) findings.not_met.push_back(words_on(one, value, before, measure));
    findings.required.push_back({{"condition", one.text},
                                 {"value", json_or_null(value)},
                                 {"before", json_or_null(before)},
                                 {"met", is_met}});
  }
}

}  // namespace meshrepair
