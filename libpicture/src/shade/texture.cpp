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

// Where `place`, of which 1 is the whole length, is among so many pixels.
Between between(double place, std::uint32_t count) {
  double within = place - std::floor(place);  // a huge number has no digits behind the point
  if (!(within >= 0 && within < 1)) within = 0;
  const double at = within * count - 0.5;
  const double before = std::floor(at);
  const auto one = static_cast<std::size_t>(before < 0 ? before + count : before);
  return {std::min<std::size_t>(one, count - 1), one + 1 >= count ? 0 : one + 1, at - before};
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

Light Texture::light(double u, double v, std::size_t copy) const {
  const Pixels& pixels = copies_[copy];
  const Between x = between(u, pixels.size.width), y = between(-v, pixels.size.height);
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
