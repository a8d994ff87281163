// SPDX-License-Identifier: MIT
// Pictures that others made, from the bytes of their files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include <mesh/attributes.h>
#include <picture/pixels.h>

namespace meshrepair {

inline constexpr std::uint32_t kMostImageSide = 16384;
inline constexpr std::size_t kMostImagePixels = std::size_t{1} << 26;

// PNG or JPEG, told by their first bytes. Throws InputError where it is neither, is broken or has
// more than `most_pixels` or a longer side than the most; what the file says of its size is looked
// at before memory is taken for it. A JPEG that ends early is as far there as it goes.
[[nodiscard]] Pixels decode_image(std::string_view bytes,
                                  std::size_t most_pixels = kMostImagePixels);

// As they are; nobody looks into them. Files are opened only within these folders. Throws
// InputError, a part of a sentence, where the picture is not there or has more bytes than `most`.
[[nodiscard]] std::string image_bytes(const Image& image,
                                      std::span<const std::filesystem::path> folders,
                                      std::uintmax_t most);

}  // namespace meshrepair
