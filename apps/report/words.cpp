// SPDX-License-Identifier: MIT
#include "report/words.h"

#include <spdlog/fmt/fmt.h>

namespace meshrepair {

std::string grouped(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (std::size_t end = text.size(); end > 3; end -= 3) text.insert(end - 3, 1, ',');
  return text;
}

std::string number_of(std::uint64_t count, std::string_view noun) {
  return fmt::format("{} {}{}", grouped(count), noun, count == 1 ? "" : "s");
}

std::string number_of(std::uint64_t count, std::string_view noun, std::string_view plural) {
  return fmt::format("{} {}", grouped(count), count == 1 ? noun : plural);
}

std::string joined_with(std::string_view mark, const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) {
    if (!text.empty()) text += mark;
    text += word;
  }
  return text;
}

std::string units_text(std::optional<LengthUnit> unit) {
  if (!unit) return "the input's units";
  if (unit == LengthUnit::inch) return "inches";
  if (unit == LengthUnit::foot) return "feet";
  return fmt::format("{}s", unit_name(*unit));
}

std::string format_words(std::string_view format, const PackedFile& packed) {
  std::string words(format);
  if (packed.packing == Packing::none) return words;
  words += " in ";
  words += packing_name(packed.packing);
  if (!packed.entry.empty()) words += ", " + packed.entry;
  return words;
}

std::string mesh_name(const Scene& scene, std::size_t mesh) {
  const std::string& name = scene.meshes[mesh].name;
  return name.empty() ? fmt::format("mesh {}", mesh) : name;
}

}  // namespace meshrepair
