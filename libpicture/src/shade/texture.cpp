// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include <base/assert.h>
#include <picture/texture.h>

namespace meshrepair {
namespace {

// Of a mean of four squares.
std::uint8_t root_of_mean(unsigned sum) {
  return static_cast<std::uint8_t>(std::floor(std::sqrt(sum / 4.0) + 0.5));
}

// The last row or column of an odd number is left out, unless it is the only one.
Pixels halved(const Pixels& pixels) {
  Pixels half;
  half.size = {std::max(1U, pixels.size.width / 2), std::max(1U, pixels.size.height / 2)};
  half.values.reserve(half.size.pixels());
  for (std::size_t y = 0; y < half.size.height; ++y) {
    const std::size_t below = std::min<std::size_t>(2 * y + 1, pixels.size.height - 1);
    for (std::size_t x = 0; x < half.size.width; ++x) {
      const std::size_t right = std::min<std::size_t>(2 * x + 1, pixels.size.width - 1);
      Rgba mean;
      for (std::size_t k = 0; k < 4; ++k) {
        unsigned sum = 0;
        for (const std::size_t row : {2 * y, below}) {
          for (const std::size_t column : {2 * x, right}) {
            const unsigned value = pixels.at(column, row)[k];
            sum += value * value;
          }
        }
        mean[k] = root_of_mean(sum);
      }
      half.values.push_back(mean);
    }
  }
  return half;
}

// Two neighbours, and how near the second is.
struct Between {
  std::size_t one, other;
  double share;
};

// The nearest alone.
Between nearest(double within, std::uint32_t count) {
  const auto one = std::min<std::size_t>(static_cast<std::size_t>(within * count), count - 1);
  return {one, one, 0};
}

// The place between 0 and 1 that a place outside stands for; NaN is 0.
double within_edges(double place, TextureSampling::Wrap wrap) {
  if (wrap == TextureSampling::Wrap::mirror) {
    const double share = place - 2 * std::floor(place / 2);  // from 0 to 2
    if (share > 1) return std::max(2 - share, 0.0);
    return share > 0 ? share : 0;
  }
  return place > 0 ? std::min(place, 1.0) : 0;
}

// Of a picture that does not begin anew behind its last pixel.
Between between_edges(double within, std::uint32_t count) {
  const double at = std::clamp(within * count - 0.5, 0.0, count - 1.0);
  const auto one = static_cast<std::size_t>(at);
  return {one, std::min<std::size_t>(one + 1, count - 1), at - static_cast<double>(one)};
}

// Where `place`, of which 1 is the whole length, is among so many pixels.
Between repeated(double place, std::uint32_t count, bool is_nearest) {
  double within = place - std::floor(place);  // a huge number has no digits behind the point
  if (!(within >= 0 && within < 1)) within = 0;
  if (is_nearest) return nearest(within, count);
  const double at = within * count - 0.5;
  const double before = std::floor(at);
  const auto one = static_cast<std::size_t>(before < 0 ? before + count : before);
  return {std::min<std::size_t>(one, count - 1), one + 1 >= count ? 0 : one + 1, at - before};
}

// Rows are counted from above, `place` from below where is_up.
Between between(double place, bool is_up, std::uint32_t count, TextureSampling::Wrap wrap,
                bool is_nearest) {
  if (wrap == TextureSampling::Wrap::repeat) {
    return repeated(is_up ? -place : place, count, is_nearest);
  }
  const double within = within_edges(is_up ? 1 - place : place, wrap);
  return is_nearest ? nearest(within, count) : between_edges(within, count);
}

bool is_outside(double place, TextureSampling::Wrap wrap) {
  return wrap == TextureSampling::Wrap::none && !(place >= 0 && place <= 1);
}

}  // namespace

Light light_of(const Rgba& colour) {
  Light light;
  for (std::size_t k = 0; k < 3; ++k) light[k] = colour[k] * colour[k] / (255.0 * 255.0);
  return light;
}

Texture::Texture(Pixels pixels) {
  MESHREPAIR_ASSERT(pixels.size.pixels() > 0);
  copies_.push_back(std::move(pixels));
  while (copies_.back().size.pixels() > 1) copies_.push_back(halved(copies_.back()));
}

std::size_t Texture::copy_for(double texels_of_sample) const {
  std::size_t copy = 0;
  constexpr double kNextIsNearer = 2;  // a copy has a quarter of the pixels
  while (texels_of_sample > kNextIsNearer && copy + 1 < copies_.size()) {
    texels_of_sample /= 4;
    ++copy;
  }
  return copy;
}

Light Texture::light(double u, double v, std::size_t copy, const TextureSampling& sampling) const {
  const auto& [wrap, filter] = sampling;
  if (is_outside(u, wrap[0]) || is_outside(v, wrap[1])) return {1, 1, 1};
  const Pixels& pixels = copies_[copy];
  const bool is_nearest = filter == TextureSampling::Filter::nearest;
  const Between x = between(u, false, pixels.size.width, wrap[0], is_nearest);
  const Between y = between(v, true, pixels.size.height, wrap[1], is_nearest);
  const Light upper_left = light_of(pixels.at(x.one, y.one));
  const Light upper_right = light_of(pixels.at(x.other, y.one));
  const Light lower_left = light_of(pixels.at(x.one, y.other));
  const Light lower_right = light_of(pixels.at(x.other, y.other));
  Light light;
  for (std::size_t k = 0; k < 3; ++k) {
    const double upper = upper_left[k] + x.share * (upper_right[k] - upper_left[k]);
    const double lower = lower_left[k] + x.share * (lower_right[k] - lower_left[k]);
    light[k] = upper + y.share * (lower - upper);
  }
  return light;
}

}  // namespace meshrepair
