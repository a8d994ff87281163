// SPDX-License-Identifier: MIT
#include "stl_colours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <utility>

#include <base/ids.h>

#include "stl_io.h"

namespace meshrepair {
namespace {

constexpr std::string_view kMagicsWord = "COLOR=";
constexpr std::uint16_t kTopBit = 0x8000;
constexpr std::uint32_t kMostOfFive = 31;  // of five bits

struct Rgb {
  std::uint32_t red, green, blue;  // up to kMostOfFive
};

Rgb rgb_of(std::uint16_t word, bool magics) {
  const std::uint32_t high = (word >> 10) & kMostOfFive, low = word & kMostOfFive;
  const std::uint32_t green = (word >> 5) & kMostOfFive;
  return magics ? Rgb{low, green, high} : Rgb{high, green, low};
}

std::uint16_t word_of(const Rgb& colour, bool magics) {
  const std::uint32_t high = magics ? colour.blue : colour.red;
  const std::uint32_t low = magics ? colour.red : colour.blue;
  return static_cast<std::uint16_t>((magics ? 0u : kTopBit) | (high << 10) | (colour.green << 5) |
                                    low);
}

// Without a colour of its own.
std::uint16_t word_of_none(bool magics) { return magics ? kTopBit : std::uint16_t{0}; }

// By bytes, which come back as the same five bits.
double share_of(std::uint32_t bits) { return std::round(bits * 255.0 / kMostOfFive) / 255; }

std::uint32_t bits_of(double share) {
  return static_cast<std::uint32_t>(std::lround(std::clamp(share, 0.0, 1.0) * kMostOfFive));
}

std::size_t find_magics_colour(std::string_view header) {
  const std::size_t at = header.find(kMagicsWord);
  const bool fits = at != std::string_view::npos && at + kMagicsWord.size() + 4 <= header.size();
  return fits ? at + kMagicsWord.size() : std::string_view::npos;
}

// One value for each of the 32,768 colours that are in use.
class ColourTable {
 public:
  ColourTable() : value_of_(std::size_t{1} << 15, kNone) {}

  std::uint32_t value_of(const Rgb& colour, std::vector<double>& values) {
    std::uint32_t& value = value_of_[(colour.red << 10) | (colour.green << 5) | colour.blue];
    if (value == kNone) {
      value = static_cast<std::uint32_t>(values.size() / 3);
      for (const std::uint32_t bits : {colour.red, colour.green, colour.blue}) {
        values.push_back(share_of(bits));
      }
    }
    return value;
  }

 private:
  std::vector<std::uint32_t> value_of_;
};

// Of all corners of a triangle; nothing where none has one.
std::uint16_t word_of_triangle(const CornerAttribute& colours, std::size_t t, bool magics) {
  std::array<double, 3> sum{};
  int count = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t value = colours.of_corner[3 * t + k];
    if (value == kNone) continue;
    ++count;
    for (std::size_t i = 0; i < 3; ++i) sum[i] += colours.values[colours.components * value + i];
  }
  if (count == 0) return word_of_none(magics);
  return word_of({bits_of(sum[0] / count), bits_of(sum[1] / count), bits_of(sum[2] / count)},
                 magics);
}

}  // namespace

Attributes read_stl_colours(std::string_view bytes, std::size_t triangles) {
  const std::string_view header = bytes.substr(0, kStlHeaderText);
  const std::size_t magics_at = find_magics_colour(header);
  const bool magics = magics_at != std::string_view::npos;
  CornerAttribute colours;
  colours.kind = CornerAttribute::Kind::colour;
  colours.place = CornerAttribute::Place::triangle;
  colours.storage = CornerAttribute::Storage::byte;
  colours.components = 3;
  colours.of_corner.reserve(3 * triangles);
  ColourTable table;
  for (std::size_t t = 0; t < triangles; ++t) {
    std::uint16_t word = 0;
    std::memcpy(&word, bytes.data() + kStlHeaderSize + (t + 1) * kStlTriangleSize - 2, 2);
    const bool has_one = ((word & kTopBit) != 0) != magics;
    const std::uint32_t value =
        has_one ? table.value_of(rgb_of(word, magics), colours.values) : kNone;
    colours.of_corner.insert(colours.of_corner.end(), 3, value);
  }
  Attributes attributes;
  if (!colours.values.empty()) attributes.corners.push_back(std::move(colours));
  if (magics) {
    auto kept = std::make_shared<StlColourHeader>();
    kept->header = header;
    attributes.keepsake = std::move(kept);
  }
  return attributes;
}

StlColours make_stl_colours(const Attributes* attributes, std::string_view plain) {
  StlColours made{std::string(plain), {}};
  if (attributes != nullptr) {
    const auto* const kept = dynamic_cast<const StlColourHeader*>(attributes->keepsake.get());
    if (kept != nullptr) made.header = kept->header;
    if (const CornerAttribute* colours = find_kind(*attributes, CornerAttribute::Kind::colour)) {
      made.words.reserve(colours->of_corner.size() / 3);
      for (std::size_t t = 0; t < colours->of_corner.size() / 3; ++t) {
        made.words.push_back(word_of_triangle(*colours, t, kept != nullptr));
      }
    }
  }
  made.header.resize(kStlHeaderText, ' ');
  return made;
}

}  // namespace meshrepair
