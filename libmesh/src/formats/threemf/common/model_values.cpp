// SPDX-License-Identifier: MIT
#include "model_values.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include <base/decimal.h>

#include "formats/common/text_scanner.h"

namespace meshrepair {
namespace {

// In the order of the values.
constexpr std::array<std::string_view, 4> kTiles = {"wrap", "mirror", "clamp", "none"};
constexpr std::array<std::string_view, 3> kFilters = {"auto", "linear", "nearest"};

template <class Value, std::size_t kCount>
Value value_named(std::string_view name, const std::array<std::string_view, kCount>& names) {
  const auto* const found = std::find(names.begin(), names.end(), without_blanks(name));
  return found == names.end() ? Value() : static_cast<Value>(found - names.begin());
}

}  // namespace

bool read_model_number(std::string_view text, double& value) {
  const std::string_view word = without_blanks(text);
  const auto [end, error] = read_decimal(word.data(), word.data() + word.size(), value);
  if (error == std::errc() && end == word.data() + word.size()) return true;
  return parse_odd_real(word, value);
}

std::uint32_t read_model_index(std::string_view text) {
  constexpr std::uint32_t kMost = std::uint32_t{1} << 31;
  std::string_view word = without_blanks(text);
  if (word.starts_with('+')) word.remove_prefix(1);
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  const bool good = error == std::errc() && end == word.data() + word.size() && value < kMost;
  return good ? value : kNone;
}

std::string_view take_word(std::string_view& text) {
  text = without_blanks(text);
  const std::string_view word =
      text.substr(0, std::min(text.find_first_of(" \t\r\n"), text.size()));
  text.remove_prefix(word.size());
  return word;
}

std::optional<ModelColour> read_model_colour(std::string_view text) {
  const std::string_view word = without_blanks(text);
  if (!word.starts_with('#') || (word.size() != 7 && word.size() != 9)) return std::nullopt;
  ModelColour colour;
  colour.has_opacity = word.size() == 9;
  for (std::size_t i = 0; 2 * i + 2 < word.size(); ++i) {
    unsigned byte = 0;
    const char* const first = word.data() + 1 + 2 * i;
    const auto [end, error] = std::from_chars(first, first + 2, byte, 16);
    if (error != std::errc() || end != first + 2) return std::nullopt;
    colour.values[i] = byte / 255.0;
  }
  return colour;
}

TextureSampling read_sampling(std::string_view tile_u, std::string_view tile_v,
                              std::string_view filter) {
  using Wrap = TextureSampling::Wrap;
  return {{value_named<Wrap>(tile_u, kTiles), value_named<Wrap>(tile_v, kTiles)},
          value_named<TextureSampling::Filter>(filter, kFilters)};
}

std::string_view tile_name(TextureSampling::Wrap wrap) {
  return kTiles[static_cast<std::size_t>(wrap)];
}

std::string_view filter_name(TextureSampling::Filter filter) {
  return kFilters[static_cast<std::size_t>(filter)];
}

std::optional<Placement> read_placement(std::string_view text) {
  Placement placement;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 3; ++column) {
      double& value = row < 3 ? placement.linear(column, row) : placement.offset[column];
      if (!read_model_number(take_word(text), value) || !std::isfinite(value)) return std::nullopt;
    }
  }
  if (!take_word(text).empty()) return std::nullopt;
  return placement;
}

}  // namespace meshrepair
