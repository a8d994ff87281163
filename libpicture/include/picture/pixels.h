// SPDX-License-Identifier: MIT
// A picture in memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace meshrepair {

using Rgba = std::array<std::uint8_t, 4>;  // red, green, blue and opacity, as in sRGB

struct PictureSize {
  std::uint32_t width = 640;  // in pixels
  std::uint32_t height = 480;

  [[nodiscard]] std::size_t pixels() const { return std::size_t{width} * height; }
  bool operator==(const PictureSize&) const = default;
};

// Row by row from the top, each from the left.
struct Pixels {
  PictureSize size = {0, 0};
  std::vector<Rgba> values;  // size.pixels()

  [[nodiscard]] const Rgba& at(std::size_t x, std::size_t y) const {
    return values[y * size.width + x];
  }
  bool operator==(const Pixels&) const = default;
};

[[nodiscard]] Pixels filled(PictureSize size, const Rgba& colour);

// One beside the other, with a bar of this width between them. Pre: they are of one height.
[[nodiscard]] Pixels beside(const Pixels& left, const Pixels& right, std::uint32_t bar,
                            const Rgba& bar_colour);

}  // namespace meshrepair
