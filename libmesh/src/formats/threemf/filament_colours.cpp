// SPDX-License-Identifier: MIT
#include "filament_colours.h"

#include <algorithm>
#include <string>

#include "common/model_values.h"
#include "formats/gltf/common/gltf_json.h"

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

std::vector<std::string> split(std::string_view list) {
  std::vector<std::string> words;
  while (words.size() < kMostFilaments) {
    const std::size_t end = list.find(';');
    words.emplace_back(without(list.substr(0, end), " \t\r\n\""));
    if (end == std::string_view::npos) return words;
    list.remove_prefix(end + 1);
  }
  return words;
}

// What stands behind "; NAME = " in a line of its own.
std::vector<std::string> list_in_lines(std::string_view settings, std::string_view name) {
  const std::string key = "; " + std::string(name) + " =";
  std::size_t at = settings.find(key);
  while (at != std::string_view::npos && at > 0 && settings[at - 1] != '\n') {
    at = settings.find(key, at + 1);
  }
  if (at == std::string_view::npos) return {};
  const std::string_view rest = settings.substr(at + key.size());
  return split(rest.substr(0, rest.find('\n')));
}

std::vector<std::string> list_in_json(const GltfJson& settings, const char* name) {
  std::vector<std::string> words;
  const GltfJson* const list = gltf_member(settings, name);
  if (list == nullptr || !list->is_array()) return words;
  for (const GltfJson& word : *list) {
    if (words.size() == kMostFilaments) break;
    words.push_back(word.is_string() ? word.get<std::string>() : std::string());
  }
  return words;
}

}  // namespace

bool is_print_settings(std::string_view key) {
  return key == "metadata/slic3r_pe.config" || key == "metadata/project_settings.config";
}

Colours read_filament_colours(std::string_view settings) {
  const GltfJson json = GltfJson::parse(settings, nullptr, false);
  const auto list = [&](const char* name) {
    return json.is_object() ? list_in_json(json, name) : list_in_lines(settings, name);
  };
  const std::vector<std::string> filaments = list("filament_colour");
  const std::vector<std::string> extruders = list("extruder_colour");
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
