// SPDX-License-Identifier: MIT
#include "filament_colours.h"

#include <algorithm>
#include <string>

#include "model_values.h"

namespace meshrepair {
namespace {

using Colours = std::vector<std::array<double, 4>>;

// A state of paint is not more.
constexpr std::size_t kMostFilaments = 1024;

std::string_view without(std::string_view text, std::string_view around) {
  const std::size_t first = text.find_first_not_of(around);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(around) - first + 1);
}

std::vector<std::string_view> split(std::string_view list, char separator) {
  std::vector<std::string_view> words;
  while (words.size() < kMostFilaments) {
    const std::size_t end = list.find(separator);
    words.push_back(without(list.substr(0, end), " \t\r\n\""));
    if (end == std::string_view::npos) return words;
    list.remove_prefix(end + 1);
  }
  return words;
}

// What stands behind "; NAME = " in a line of its own.
std::vector<std::string_view> list_in_lines(std::string_view settings, std::string_view name) {
  const std::string key = "; " + std::string(name) + " =";
  std::size_t at = settings.find(key);
  while (at != std::string_view::npos && at > 0 && settings[at - 1] != '\n') {
    at = settings.find(key, at + 1);
  }
  if (at == std::string_view::npos) return {};
  const std::string_view rest = settings.substr(at + key.size());
  return split(rest.substr(0, rest.find('\n')), ';');
}

std::vector<std::string_view> list_in_json(std::string_view settings, std::string_view name) {
  const std::size_t at = settings.find('"' + std::string(name) + '"');
  if (at == std::string_view::npos) return {};
  const std::size_t first = settings.find('[', at), last = settings.find(']', at);
  if (first == std::string_view::npos || last == std::string_view::npos || last < first) return {};
  return split(settings.substr(first + 1, last - first - 1), ',');
}

}  // namespace

bool is_print_settings(std::string_view key) {
  return key == "metadata/slic3r_pe.config" || key == "metadata/project_settings.config";
}

Colours read_filament_colours(std::string_view settings) {
  const bool is_json = without(settings, " \t\r\n").starts_with('{');
  const auto list = [&](std::string_view name) {
    return is_json ? list_in_json(settings, name) : list_in_lines(settings, name);
  };
  const std::vector<std::string_view> filaments = list("filament_colour");
  const std::vector<std::string_view> extruders = list("extruder_colour");
  Colours colours;
  for (std::size_t i = 0; i < std::max(filaments.size(), extruders.size()); ++i) {
    std::optional<ModelColour> colour;
    if (i < extruders.size()) colour = read_model_colour(extruders[i]);
    if (!colour && i < filaments.size()) colour = read_model_colour(filaments[i]);
    colours.push_back(colour.value_or(ModelColour()).values);
  }
  return colours;
}

}  // namespace meshrepair
