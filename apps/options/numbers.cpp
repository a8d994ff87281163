// SPDX-License-Identifier: MIT
#include "options/numbers.h"

#include <cmath>

#include <spdlog/fmt/fmt.h>

#include <base/decimal.h>

namespace meshrepair {
namespace {

template <class Number>
std::optional<Number> parsed(std::string_view word) {
  Number number = 0;
  const char* const end = word.data() + word.size();
  const auto [at, error] = read_decimal(word.data(), end, number);
  if (error != std::errc() || at != end) return std::nullopt;
  return number;
}

std::string range_text(double least, double most) {
  return std::isfinite(most) ? fmt::format("from {} to {}", least, most)
                             : fmt::format("from {} on", least);
}

std::string range_text(std::size_t least, std::size_t most) {
  return most < std::numeric_limits<std::size_t>::max() ? fmt::format("from {} to {}", least, most)
                                                        : fmt::format("from {} on", least);
}

}  // namespace

std::optional<double> parse_number(std::string_view word) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  return parsed<double>(word);
}

std::optional<std::size_t> parse_count(std::string_view word) { return parsed<std::size_t>(word); }

std::optional<std::pair<double, bool>> distance_in(std::string_view word) {
  const bool is_share = word.ends_with('%');
  if (is_share) word.remove_suffix(1);
  const std::optional<double> value = parse_number(word);
  if (!value || !std::isfinite(*value) || *value < 0) return {};
  return std::pair(is_share ? *value / 100 : *value, is_share);
}

std::optional<std::pair<double, bool>> length_in(std::string_view word) {
  const auto length = distance_in(word);
  return length && length->first > 0 ? length : std::nullopt;
}

std::optional<Vec3d> vector_in(std::string_view word) {
  Vec3d vector;
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t comma = word.find(',');
    if ((comma == std::string_view::npos) != (axis == 2)) return std::nullopt;
    const std::optional<double> number = parse_number(word.substr(0, comma));
    if (!number || !std::isfinite(*number)) return std::nullopt;
    vector[axis] = *number;
    word.remove_prefix(axis == 2 ? word.size() : comma + 1);
  }
  return vector;
}

std::string why_no_length(const std::string& word) {
  return length_in(word) ? std::string()
                         : word + " is no length: a number above 0, or one with a % behind it";
}

CommandOption* add_length_option(CommandLine& app, const std::string& name, double& length,
                                 bool& is_share, const std::string& description,
                                 const std::string& group) {
  return app
      .add_option_function(
          name,
          [&length, &is_share](const std::string& word) {
            std::tie(length, is_share) = *length_in(word);
          },
          description)
      ->check(why_no_length)
      ->type_name("X|X%")
      ->group(group);
}

WhyNot number_between(double least, double most) {
  return [least, most](const std::string& word) {
    const std::optional<double> number = parse_number(word);
    const bool is_one = number && std::isfinite(*number) && *number >= least && *number <= most;
    return is_one ? std::string() : "'" + word + "' is not a number " + range_text(least, most);
  };
}

WhyNot count_between(std::size_t least, std::size_t most) {
  return [least, most](const std::string& word) {
    const std::optional<std::size_t> count = parse_count(word);
    const bool is_one = count && *count >= least && *count <= most;
    return is_one ? std::string()
                  : "'" + word + "' is not a whole number " + range_text(least, most);
  };
}

}  // namespace meshrepair
