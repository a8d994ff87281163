// SPDX-License-Identifier: MIT
// A picture that is spread over a surface.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <mesh/attributes.h>
#include <picture/pixels.h>

namespace meshrepair {

// Red, green and blue as light: squares of what pixels have, which is near enough to what screens
// do, and is the same everywhere. From 0 to 1.
using Light = std::array<double, 3>;

[[nodiscard]] Light light_of(const Rgba& colour);

// With smaller and smaller copies of itself, for where it is seen from afar.
class Texture {
 public:
  explicit Texture(Pixels pixels);

  // The copy whose pixels are about as large as a sample, if a sample has so many of the texture's.
  [[nodiscard]] std::size_t copy_for(double texels_of_sample) const;
  // Between the four nearest pixels, or that of the nearest. u is to the right and v up. White
  // where there is nothing of the picture, so that what it lies on stays as it is.
  [[nodiscard]] Light light(double u, double v, std::size_t copy,
                            const TextureSampling& sampling = {}) const;

  [[nodiscard]] PictureSize size() const { return copies_.front().size; }

 private:
  std::vector<Pixels> copies_;
};

}  // namespace meshrepair
