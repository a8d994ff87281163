// SPDX-License-Identifier: MIT
// Pictures in the formats that others write: JPEG by libjpeg, PNG by libpng.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include <base/error.h>
#include <picture/decode_image.h>
#include <picture/pixels.h>

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

[[nodiscard]] bool begins_with_jpeg(std::string_view bytes);

// Throws InputError.
[[nodiscard]] Pixels read_jpeg(std::string_view bytes, std::size_t most_pixels);

[[nodiscard]] bool begins_with_png(std::string_view bytes);

// Throws InputError.
[[nodiscard]] Pixels read_png(std::string_view bytes, std::size_t most_pixels);

}  // namespace meshrepair
