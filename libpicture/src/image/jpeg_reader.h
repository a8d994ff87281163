// JPEG, by libjpeg.
#pragma once

#include <cstddef>
#include <string_view>

#include <picture/pixels.h>

namespace meshrepair {

[[nodiscard]] bool begins_with_jpeg(std::string_view bytes);

// Throws InputError.
[[nodiscard]] Pixels read_jpeg(std::string_view bytes, std::size_t most_pixels);

}  // namespace meshrepair
