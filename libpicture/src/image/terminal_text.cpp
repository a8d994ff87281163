// SPDX-License-Identifier: MIT
#include "picture/terminal_text.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include <base/assert.h>
#include <base/base64.h>

#include "picture/png_io.h"

namespace meshrepair {
namespace {

constexpr std::size_t kMostColours = 256;
constexpr std::size_t kBandHeight = 6;      // pixels that a sixel has
constexpr std::size_t kPieceLength = 4096;  // characters of a piece for kitty
constexpr unsigned kShadeBits = 5;          // of red, green and blue: colours that are alike
constexpr std::size_t kShades = std::size_t{1} << (3 * kShadeBits);

std::size_t shade_of(const Rgba& pixel) {
  std::size_t shade = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    shade = (shade << kShadeBits) | static_cast<std::size_t>(pixel[i] >> (8 - kShadeBits));
  }
  return shade;
}

// The colours of a picture, and the nearest of them for each of its pixels.
class Palette {
 public:
  explicit Palette(const Pixels& pixels) : of_shade_(kShades, 0) {
    std::vector<std::array<std::uint64_t, 4>> sums(kShades);  // of red, green, blue; their number
    for (const Rgba& pixel : pixels.values) {
      auto& sum = sums[shade_of(pixel)];
      for (std::size_t i = 0; i < 3; ++i) sum[i] += pixel[i];
      ++sum[3];
    }
    std::vector<std::size_t> shades;
    for (std::size_t shade = 0; shade < kShades; ++shade) {
      if (sums[shade][3] > 0) shades.push_back(shade);
    }
    std::stable_sort(shades.begin(), shades.end(),
                     [&](std::size_t a, std::size_t b) { return sums[a][3] > sums[b][3]; });
    for (std::size_t i = 0; i < shades.size(); ++i) {
      const auto& [red, green, blue, count] = sums[shades[i]];
      const std::array<std::uint64_t, 3> mean = {
          (red + count / 2) / count, (green + count / 2) / count, (blue + count / 2) / count};
      if (i < kMostColours) colours_.push_back(mean);
      of_shade_[shades[i]] = i < kMostColours ? i : nearest(mean);
    }
  }

  [[nodiscard]] std::size_t colour_of(const Rgba& pixel) const {
    return of_shade_[shade_of(pixel)];
  }

  // "#0;2;100;0;0" is red, in percent.
  [[nodiscard]] std::string definitions() const {
    std::string text;
    for (std::size_t i = 0; i < colours_.size(); ++i) {
      text += '#' + std::to_string(i) + ";2";
      for (const std::uint64_t value : colours_[i]) {
        text += ';' + std::to_string((value * 100 + 127) / 255);
      }
    }
    return text;
  }

  [[nodiscard]] std::size_t size() const { return colours_.size(); }

 private:
  [[nodiscard]] std::size_t nearest(const std::array<std::uint64_t, 3>& colour) const {
    std::size_t best = 0;
    std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
    for (std::size_t i = 0; i < colours_.size(); ++i) {
      std::uint64_t distance = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint64_t step =
            std::max(colour[k], colours_[i][k]) - std::min(colour[k], colours_[i][k]);
        distance += step * step;
      }
      if (distance < least) {
        least = distance;
        best = i;
      }
    }
    return best;
  }

  std::vector<std::array<std::uint64_t, 3>> colours_;
  std::vector<std::size_t> of_shade_;
};

// Of one colour: which of the six pixels of each column have it. Runs are told by their length.
std::string band_text(const std::vector<unsigned char>& columns) {
  std::size_t end = columns.size();
  while (end > 0 && columns[end - 1] == 0) --end;
  std::string text;
  for (std::size_t i = 0; i < end;) {
    std::size_t run = 1;
    while (i + run < end && columns[i + run] == columns[i]) ++run;
    const char character = static_cast<char>('?' + columns[i]);
    if (run > 3) {
      text += '!' + std::to_string(run) + character;
    } else {
      text.append(run, character);
    }
    i += run;
  }
  return text;
}

void append_band(const Pixels& pixels, const Palette& palette, std::size_t top, std::string& text) {
  const std::size_t width = pixels.size.width;
  const std::size_t bottom = std::min<std::size_t>(top + kBandHeight, pixels.size.height);
  std::vector<std::vector<unsigned char>> columns(palette.size());
  for (std::size_t y = top; y < bottom; ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      std::vector<unsigned char>& of_colour = columns[palette.colour_of(pixels.at(x, y))];
      of_colour.resize(width, 0);
      of_colour[x] = static_cast<unsigned char>(of_colour[x] | (1U << (y - top)));
    }
  }
  bool is_first = true;
  for (std::size_t colour = 0; colour < columns.size(); ++colour) {
    if (columns[colour].empty()) continue;
    if (!is_first) text += '$';  // back to the left
    is_first = false;
    text += '#' + std::to_string(colour) + band_text(columns[colour]);
  }
  text += '-';
}

}  // namespace

std::string format_sixel(const Pixels& pixels) {
  MESHREPAIR_ASSERT(!pixels.values.empty());
  const Palette palette(pixels);
  std::string text = "\x1bP0;1;0q\"1;1;" + std::to_string(pixels.size.width) + ';' +
                     std::to_string(pixels.size.height) + palette.definitions();
  for (std::size_t top = 0; top < pixels.size.height; top += kBandHeight) {
    append_band(pixels, palette, top, text);
  }
  return text + "\x1b\\";
}

std::string format_kitty(const Pixels& pixels) {
  const std::string data = encode_base64(format_png(pixels));
  std::string text;
  for (std::size_t first = 0; first < data.size(); first += kPieceLength) {
    const bool is_last = first + kPieceLength >= data.size();
    // Drawn at once (a=T), as PNG (f=100), without an answer (q=2).
    text +=
        std::string("\x1b_G") + (first == 0 ? "a=T,f=100,q=2," : "") + (is_last ? "m=0;" : "m=1;");
    text += std::string_view(data).substr(first, kPieceLength);
    text += "\x1b\\";
  }
  return text;
}

}  // namespace meshrepair
