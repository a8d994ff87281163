// Which pictures are too large to be looked at.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include <base/error.h>
#include <picture/decode_image.h>

namespace meshrepair {

// What a file says of itself. Throws InputError.
[[nodiscard]] inline PictureSize checked_image_size(std::uint64_t width, std::uint64_t height,
                                                    std::size_t most_pixels) {
  if (width == 0 || height == 0) throw InputError("has no pixels");
  // No product of more than 64 bits.
  const bool is_long = width > kMostImageSide || height > kMostImageSide;
  if (is_long || width * height > most_pixels) {
    throw InputError("is too large: " + std::to_string(width) + " x " + std::to_string(height) +
                     " pixels");
  }
  return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
}

}  // namespace meshrepair
