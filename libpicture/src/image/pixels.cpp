// SPDX-License-Identifier: MIT
#include <algorithm>

#include <base/assert.h>
#include <picture/pixels.h>

namespace meshrepair {

Pixels filled(PictureSize size, const Rgba& colour) {
  return {size, std::vector<Rgba>(size.pixels(), colour)};
}

Pixels beside(const Pixels& left, const Pixels& right, std::uint32_t bar, const Rgba& bar_colour) {
  MESHREPAIR_ASSERT(left.size.height == right.size.height);
  Pixels both;
  both.size = {left.size.width + bar + right.size.width, left.size.height};
  both.values.reserve(both.size.pixels());
  const auto add_row = [&](const Pixels& from, std::size_t y) {
    const auto begin = from.values.begin() + static_cast<std::ptrdiff_t>(y * from.size.width);
    both.values.insert(both.values.end(), begin,
                       begin + static_cast<std::ptrdiff_t>(from.size.width));
  };
  for (std::size_t y = 0; y < both.size.height; ++y) {
    add_row(left, y);
    both.values.insert(both.values.end(), bar, bar_colour);
    add_row(right, y);
  }
  return both;
}

}  // namespace meshrepair
