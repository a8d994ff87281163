// SPDX-License-Identifier: MIT
#include "mtl_text.h"

#include <array>
#include <optional>

#include "formats/common/text_scanner.h"

namespace meshrepair {
namespace {

std::optional<double> number_of(std::string_view word) {
  double value = 0;
  TextScanner text(word);
  if (!text.next_on_line() || !text.read_real(value)) return std::nullopt;
  return value;
}

// How many words an option of a map takes at most, and whether they are numbers. Of -o, -s and -t
// the last two may be missing.
struct MapOption {
  std::string_view name;
  std::size_t words;
  bool numbers;
};

constexpr std::array<MapOption, 12> kOptions = {{{"-blendu", 1, false},
                                                 {"-blendv", 1, false},
                                                 {"-boost", 1, true},
                                                 {"-mm", 2, true},
                                                 {"-o", 3, true},
                                                 {"-s", 3, true},
                                                 {"-t", 3, true},
                                                 {"-texres", 1, true},
                                                 {"-clamp", 1, false},
                                                 {"-bm", 1, true},
                                                 {"-imfchan", 1, false},
                                                 {"-type", 1, false}}};

}  // namespace

MtlLine split_mtl_line(std::string_view text) {
  text = without_blanks(text);
  const std::size_t end = std::min(text.find_first_of(" \t"), text.size());
  return {text.substr(0, end), without_blanks(text.substr(end))};
}

bool names_picture(std::string_view key) {
  constexpr std::array<std::string_view, 6> kKeys = {"bump", "disp", "decal",
                                                     "refl", "norm", "map_"};
  return std::any_of(kKeys.begin(), kKeys.end(), [&](std::string_view known) {
    return known.back() == '_' ? equals_ignoring_case(key.substr(0, known.size()), known)
                               : equals_ignoring_case(key, known);
  });
}

MtlMap read_mtl_map(std::string_view rest) {
  MtlMap map{rest};
  while (true) {
    const MtlLine first = split_mtl_line(map.picture);
    const auto* const option =
        std::find_if(kOptions.begin(), kOptions.end(),
                     [&](const MapOption& known) { return known.name == first.key; });
    if (option == kOptions.end()) return map;
    map.picture = first.rest;
    for (std::size_t i = 0; i < option->words; ++i) {
      const MtlLine word = split_mtl_line(map.picture);
      const auto number = option->numbers ? number_of(word.key) : std::nullopt;
      if (word.rest.empty() || (option->numbers && !number)) break;
      map.picture = word.rest;
      if (option->name == "-clamp") map.is_clamped = equals_ignoring_case(word.key, "on");
      if (number && i < 2 && option->name == "-o") map.offset[i] = *number;
      if (number && i < 2 && option->name == "-s") map.scale[i] = *number;
    }
  }
}

std::string_view picture_of(std::string_view rest) { return read_mtl_map(rest).picture; }

std::string with_slashes(std::string_view name) {
  std::string path(name);
  std::replace(path.begin(), path.end(), '\\', '/');
  return path;
}

}  // namespace meshrepair
